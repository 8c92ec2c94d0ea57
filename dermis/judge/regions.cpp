#include "dermis/judge/regions.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/parallel.h"
#include "dermis/judge/point_grid.h"
#include "dermis/rays/camera_ray.h"
#include "dermis/rays/flesh.h"
#include "dermis/rays/ray_scene.h"
#include "dermis/reference/lighting.h"
#include "dermis/reference/materials.h"

namespace dermis::inline judge {
namespace {

// What says to which region the skin in a pixel's middle belongs.
struct RegionPoint {
    bool skin = false;
    Vec3 p_mm;
    float n_dot_l = 0;         // shading normal, key light
    bool faces_light = false;  // by the interpolated normal, so that its shadow is a cast one
    bool lit = false;          // nothing between it and the key light
    float thickness_mm = 0;    // to the next skin behind it; large where there is none
    float curvature_per_mm = 0;
};

// Cosine from which a surface faces the light; lower ones may lie behind their own facet.
constexpr float kFacesLight = 0.1f;

float curvature_at(const Mesh& mesh, const RayHit& hit) {
    if (mesh.curvatures_per_mm.empty()) return 0;
    const auto corner = [&](size_t k) {
        return mean_curvature(mesh.curvatures_per_mm[mesh.indices[3 * size_t(hit.triangle) + k]]);
    };
    return corner(0) * (1 - hit.u - hit.v) + corner(1) * hit.u + corner(2) * hit.v;
}

// Everything that a pixel's point is found with.
struct Finder {
    const Scene& scene;
    const RayScene& rays;
    const MaterialSet& materials;
    Mat4 inverse_view_projection;
    int width, height;

    [[nodiscard]] float thickness_mm(const SurfaceAttributes& surface) const {
        const auto behind = rays.closest_hit(RaySet::skin, {.origin_mm = surface.p_world_mm,
                                                            .direction = -surface.n_geometry_world,
                                                            .min_mm = 10 * rays.epsilon_mm()});
        return behind ? behind->distance_mm : 1e30f;
    }

    [[nodiscard]] RegionPoint point(int x, int y) const {
        const auto hit = rays.closest_hit(RaySet::opaque, camera_ray(inverse_view_projection, float(x) + 0.5f,
                                                                     float(y) + 0.5f, width, height));
        if (!hit) return {};
        const SurfaceAttributes surface = rays.surface_at(*hit);
        const ShadingPoint shading = materials.shade(surface, *hit);
        const LightArrival light = light_at(scene.key_light(), surface.p_world_mm);
        const float offset_mm = 10 * rays.epsilon_mm();
        RegionPoint point{.skin = shading.material_class == MaterialClass::skin,
                          .p_mm = surface.p_world_mm,
                          .n_dot_l = dot(shading.n, light.to_light),
                          .faces_light = dot(shading.n_geometry, light.to_light) > kFacesLight,
                          .thickness_mm = thickness_mm(surface),
                          .curvature_per_mm = curvature_at(scene.objects[hit->object].mesh, *hit)};
        point.lit =
            point.faces_light &&
            !rays.occluded(RaySet::opaque, {.origin_mm = shading.p_smooth_mm + shading.n_geometry * offset_mm,
                                            .direction = light.to_light,
                                            .min_mm = offset_mm,
                                            .max_mm = light.distance_mm});
        return point;
    }
};

Result<std::vector<RegionPoint>> find_region_points(const Scene& scene, const Image& mask) {
    DERMIS_TRY_ASSIGN(const RayScene rays, RayScene::build(scene.objects));
    DERMIS_TRY_ASSIGN(const MaterialSet materials, MaterialSet::load(scene));
    const float aspect = float(mask.width) / float(mask.height);
    const Finder finder{scene,      rays,
                        materials,  camera_matrices(scene.camera, aspect).inverse_view_projection,
                        mask.width, mask.height};
    std::vector<RegionPoint> points(mask.pixel_count());
    parallel_for(size_t(mask.height), 4, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y)
            for (size_t x = 0; x < size_t(mask.width); ++x)
                if (const size_t i = y * size_t(mask.width) + x; mask.floats()[i] > 0)
                    points[i] = finder.point(int(x), int(y));
    });
    return points;
}

Image near_points(const std::vector<RegionPoint>& points, const std::vector<Vec3>& others_mm, float near_mm,
                  int width, int height) {
    Image near(width, height, 1);
    const PointGrid grid(others_mm, near_mm);
    for (size_t i = 0; i < points.size(); ++i)
        near.floats()[i] = points[i].skin && grid.any_near(points[i].p_mm) ? 1 : 0;
    return near;
}

std::vector<Vec3> shadow_edges_mm(const std::vector<RegionPoint>& points, int width, int height,
                                  float near_mm) {
    std::vector<Vec3> edges_mm;
    const auto compare = [&](const RegionPoint& a, const RegionPoint& b) {
        const bool both = a.skin && b.skin && a.faces_light && b.faces_light;
        if (both && a.lit != b.lit && length(a.p_mm - b.p_mm) <= near_mm)
            edges_mm.push_back((a.p_mm + b.p_mm) * 0.5f);
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const size_t i = size_t(y) * size_t(width) + size_t(x);
            if (x + 1 < width) compare(points[i], points[i + 1]);
            if (y + 1 < height) compare(points[i], points[i + size_t(width)]);
        }
    return edges_mm;
}

Result<std::vector<Vec3>> hidden_skin_mm(const Scene& scene) {
    DERMIS_TRY_ASSIGN(const std::vector<Flesh> flesh, find_flesh(scene.objects));
    std::vector<Vec3> hidden_mm;
    for (size_t object = 0; object < flesh.size(); ++object) {
        const Mesh& mesh = scene.objects[object].mesh;
        for (size_t triangle = 0; triangle < flesh[object].faces.size(); ++triangle) {
            if (flesh[object].faces[triangle] == SkinFace::visible) continue;
            const uint32_t* corner = &mesh.indices[3 * triangle];
            hidden_mm.push_back(
                (mesh.positions_mm[corner[0]] + mesh.positions_mm[corner[1]] + mesh.positions_mm[corner[2]]) *
                (1 / 3.0f));
        }
    }
    return hidden_mm;
}

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
