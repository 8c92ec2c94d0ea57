#include "dermis/judge/regions.h"

#include <algorithm>
#include <cmath>

#include "dermis/judge/region_points.h"

namespace dermis::inline judge {
namespace {

struct RegionEntry {
    std::string_view name, text;
    Vec3 color;  // sRGB
};

// In the order of the enumeration. Colours that differ in lightness too.
constexpr RegionEntry kEntries[] = {
    {"relief", "lit, N·L above 0.3, no edge of a cast shadow within 3 mm", {0.55f, 0.55f, 0.55f}},
    {"terminator", "N·L within 0.3 of 0, no edge of a cast shadow within 3 mm", {0.98f, 0.75f, 0.18f}},
    {"shadow_edge", "within 3 mm of the edge of a cast shadow", {0.16f, 0.42f, 0.85f}},
    {"thin", "less than 6 mm of skin behind the surface", {0.93f, 0.36f, 0.28f}},
    {"concave", "curvature below -0.05 per mm, or hidden skin within 3 mm", {0.45f, 0.20f, 0.62f}},
    {"convex", "curvature above 0.1 per mm", {0.30f, 0.80f, 0.62f}}};
static_assert(std::size(kEntries) == kRegions.size());
static_assert(kReliefCosine == 0.3f && kNearMm == 3 && kThinMm == 6 && kConcavePerMm == -0.05f &&
                  kConvexPerMm == 0.1f,
              "the texts above state the limits");

bool belongs(const RegionPoint& point, Region region, bool near_edge, bool near_hidden) {
    switch (region) {
        case Region::relief:
            return point.lit && point.n_dot_l > kReliefCosine && !near_edge;
        case Region::terminator:
            return std::abs(point.n_dot_l) <= kReliefCosine && !near_edge;
        case Region::shadow_edge:
            return near_edge;
        case Region::thin:
            return point.thickness_mm < kThinMm;
        case Region::concave:
            return point.curvature_per_mm < kConcavePerMm || near_hidden;
        case Region::convex:
            return point.curvature_per_mm > kConvexPerMm;
    }
    return false;
}

}  // namespace

std::string_view region_name(Region region) {
    return kEntries[size_t(region)].name;
}

std::string region_text(Region region) {
    return std::string(kEntries[size_t(region)].text);
}

Vec3 region_color(Region region) {
    return kEntries[size_t(region)].color;
}

Result<RegionMasks> find_regions(const Scene& scene, const Image& skin) {
    DERMIS_TRY_ASSIGN(const std::vector<RegionPoint> points, find_region_points(scene, skin));
    DERMIS_TRY_ASSIGN(const std::vector<Vec3> hidden_mm, hidden_skin_mm(scene));
    const int width = skin.width, height = skin.height;
    const Image near_edge =
        near_points(points, shadow_edges_mm(points, width, height, kNearMm), kNearMm, width, height);
    const Image near_hidden = near_points(points, hidden_mm, kNearMm, width, height);
    RegionMasks masks;
    for (const Region region : kRegions) {
        Image& mask = masks[size_t(region)] = Image(width, height, 1);
        for (size_t i = 0; i < points.size(); ++i)
            if (points[i].skin &&
                belongs(points[i], region, near_edge.floats()[i] > 0, near_hidden.floats()[i] > 0))
                mask.floats()[i] = 1;
    }
    return masks;
}

Image region_picture(const RegionMasks& regions, const Image& skin) {
    constexpr Vec3 kNone = {0.25f, 0.25f, 0.26f}, kOutsideRegions = {0.11f, 0.11f, 0.12f};
    Image picture(skin.width, skin.height, 3, PixelFormat::u8, Encoding::srgb);
    for (size_t i = 0; i < skin.pixel_count(); ++i) {
        const size_t x = i % size_t(skin.width), y = i / size_t(skin.width);
        std::vector<Region> own;
        for (const Region region : kRegions)
            if (regions[size_t(region)].floats()[i] > 0) own.push_back(region);
        // Stripes where regions overlap.
        constexpr size_t kStripePixels = 3;
        Vec3 c = skin.floats()[i] > 0 ? kNone : kOutsideRegions;
        if (!own.empty()) c = region_color(own[(x + y) / kStripePixels % own.size()]);
        const float channels[3] = {c.x, c.y, c.z};
        for (size_t k = 0; k < 3; ++k)
            picture.values<uint8_t>()[3 * i + k] = uint8_t(std::lround(channels[k] * 255));
    }
    return picture;
}

Result<std::vector<RegionShare>> captured_by_region(const Image& technique_effect,
                                                    const EffectHalves& reference,
                                                    const RegionMasks& regions) {
    std::vector<RegionShare> shares;
    for (const Region region : kRegions) {
        const Image& mask = regions[size_t(region)];
        RegionShare share{.region = region};
        if (std::ranges::any_of(mask.floats(), [](float v) { return v > 0; })) {
            DERMIS_TRY_ASSIGN(const Captured found, captured(technique_effect, reference, mask));
            share.captured = found;
        }
        shares.push_back(std::move(share));
    }
    return shares;
}

}  // namespace dermis::inline judge
