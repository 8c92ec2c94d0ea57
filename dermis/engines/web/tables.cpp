#include "dermis/engines/web/parts.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/text.h"
#include "dermis/image/half.h"
#include "dermis/image/resample.h"
#include "dermis/scene/brdf_table.h"
#include "dermis/scene/environment.h"

namespace dermis::inline engines::web {
namespace {

// The renderer's table goes further; more than this a head has in a few creases only.
constexpr int kTableWidth = 128, kTableHeight = 64;
constexpr float kPageCurvaturePerMm = 0.6f;
// Half the texels of the technique's rows.
constexpr int kRowWidth = 129;
// First level of the prefiltered cube in the page: 128 texels, for mirrors.
constexpr int kFirstLevel = 1;

Result<Image> image_of(const TableImage& table) {
    if (table.format != ImageFormat::rgba32f) return Error{"table " + table.name + " is not rgba32f"};
    Image image(table.width, table.height, 4);
    std::memcpy(image.floats().data(), table.bytes.data(), table.bytes.size());
    return image;
}

// The whole texture covers the range, so texel centres lie half a texel inside.
void put_diffuse(Binary& binary, const Image& baked, float baked_curvature_per_mm) {
    for (int y = 0; y < kTableHeight; ++y)
        for (int x = 0; x < kTableWidth; ++x) {
            const Vec2 uv = {(float(x) + 0.5f) / kTableWidth,
                             (float(y) + 0.5f) / kTableHeight * kPageCurvaturePerMm / baked_curvature_per_mm};
            const Vec4 light = sample_bilinear(baked, uv);
            binary.put(shared_exponent({light.x, light.y, light.z}));
        }
}

// A row whose ends are at its first and last texel's centre.
void put_row(Binary& binary, const Image& baked, int row) {
    for (int x = 0; x < kRowWidth; ++x) {
        const float at = float(x) / (kRowWidth - 1) * float(baked.width - 1) + 0.5f;
        const Vec4 value =
            sample_bilinear(baked, {at / float(baked.width), (float(row) + 0.5f) / float(baked.height)});
        for (const float c : {value.x, value.y, value.z, value.w}) binary.put(to_half(c));
    }
}

}  // namespace

nlohmann::json to_json(float value) {
    return parse_number(to_text(value)).value_or(0);
}

nlohmann::json to_json(Vec3 v) {
    return nlohmann::json::array({to_json(v.x), to_json(v.y), to_json(v.z)});
}

Result<nlohmann::json> add_tables(Binary& binary, std::span<const WebTone> tones,
                                  float baked_curvature_per_mm) {
    nlohmann::json made;
    made["diffuse"] = {{"offset", binary.begin_block()},
                       {"width", kTableWidth},
                       {"height", kTableHeight},
                       {"max_curvature_per_mm", kPageCurvaturePerMm}};
    for (const WebTone& tone : tones) {
        DERMIS_TRY_ASSIGN(const Image table, image_of(tone.diffuse_table));
        put_diffuse(binary, table, baked_curvature_per_mm);
    }
    nlohmann::json& rows = made["rows"];
    rows = {{"offset", binary.begin_block()}, {"width", kRowWidth}, {"height", 0}};
    for (const WebTone& tone : tones) {
        DERMIS_TRY_ASSIGN(const Image table, image_of(tone.rows_table));
        rows["height"] = table.height;
        for (int y = 0; y < table.height; ++y) put_row(binary, table, y);
    }
    return made;
}

Result<nlohmann::json> add_environment(Binary& binary, const Environment& environment) {
    DERMIS_TRY_ASSIGN(const EnvironmentLight light, prepare_environment(environment));
    DERMIS_TRY_ASSIGN(const std::vector<std::byte> brdf, stored_brdf_table());
    nlohmann::json made = {
        {"intensity", to_json(environment.kind == EnvironmentKind::none ? 0.0f : environment.intensity)},
        {"yaw_rad", to_json(environment.yaw_rad)},
        {"radiance_sh", nlohmann::json::array()}};
    for (const Vec3& coefficient : light.radiance_sh) made["radiance_sh"].push_back(to_json(coefficient));

    const int first = std::min(kFirstLevel, light.mips - 1);
    made["cube"] = {{"offset", binary.begin_block()},
                    {"side", light.base_size >> first},
                    {"levels", light.mips - first},
                    {"first_level", first}};
    size_t skipped = 0;
    for (int level = 0; level < first; ++level)
        skipped += 6 * size_t(light.base_size >> level) * size_t(light.base_size >> level);
    const auto halves =
        std::span(reinterpret_cast<const uint16_t*>(light.cube.data()), light.cube.size() / 2);
    for (size_t i = 4 * skipped; i + 3 < halves.size(); i += 4)
        binary.put(
            shared_exponent({from_half(halves[i]), from_half(halves[i + 1]), from_half(halves[i + 2])}));
    made["brdf"] = {{"offset", binary.begin_block()}, {"side", kBrdfTableSize}};
    // Scale and bias of GGX are the first half of each texel.
    constexpr size_t kTexel = 4 * sizeof(uint16_t), kTexels = size_t(kBrdfTableSize) * kBrdfTableSize;
    for (size_t i = 0; i < kTexels * kTexel; ++i)
        if (i % kTexel < kTexel / 2) binary.put(brdf[i]);
    return made;
}

// EXT_texture_shared_exponent, section "Encoding of shared-exponent": bias 15, mantissas without a leading 1.
uint32_t shared_exponent(Vec3 color_linear) {
    constexpr int kBias = 15, kMantissaBits = 9;
    constexpr float kMax = 65408;
    const float r = std::clamp(color_linear.x, 0.0f, kMax), g = std::clamp(color_linear.y, 0.0f, kMax),
                b = std::clamp(color_linear.z, 0.0f, kMax);
    const float largest = std::max({r, g, b, std::ldexp(1.0f, -kBias)});
    int exponent = std::max(-kBias - 1, int(std::floor(std::log2(largest)))) + 1 + kBias;
    const auto mantissa = [&](float value) {
        return uint32_t(std::floor(std::ldexp(value, kBias + kMantissaBits - exponent) + 0.5f));
    };
    if (mantissa(largest) == 1u << kMantissaBits) ++exponent;
    return mantissa(r) | mantissa(g) << 9 | mantissa(b) << 18 | uint32_t(exponent) << 27;
}

}  // namespace dermis::inline engines::web
