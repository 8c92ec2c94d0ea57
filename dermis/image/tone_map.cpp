#include "dermis/image/tone_map.h"

#include <algorithm>
#include <array>
#include <vector>

#include "dermis/base/parallel.h"
#include "dermis/base/text.h"
#include "dermis/image/colour.h"

namespace dermis::inline image {
namespace {

template <class Curve>
Vec3 each(Vec3 c, Curve curve) {
    return {curve(c.x), curve(c.y), curve(c.z)};
}

float clamp_display(float x) {
    return std::clamp(x, 0.0f, 1.0f);
}

// Hable 2010: shoulder strength A, linear strength B and angle C, toe strength D, numerator E, denominator F,
// linear white W; the constants and the bias of 2 before the curve are those of his published example.
float hable_curve(float x) {
    constexpr float A = 0.15f, B = 0.50f, C = 0.10f, D = 0.20f, E = 0.02f, F = 0.30f;
    // (x (A x + C B) + D E) / (x (A x + B) + D F) - E / F on one denominator, where the terms without x
    // cancel: black is exactly 0.
    return x * (A * x + C * B - E / F * (A * x + B)) / (x * (A * x + B) + D * F);
}
Vec3 hable(Vec3 c) {
    constexpr float kExposureBias = 2.0f, kWhite = 11.2f;
    const float scale = 1.0f / hable_curve(kWhite);
    return each(c, [=](float x) { return clamp_display(scale * hable_curve(kExposureBias * x)); });
}

// Hill 2016: linear sRGB to AP1 with the reference transform's desaturation, the curve, and back. The curve
// is slightly negative at 0, which the clamp removes.
Vec3 aces(Vec3 c) {
    constexpr Mat3 kIn = {
        {{0.59719f, 0.35458f, 0.04823f}, {0.07600f, 0.90834f, 0.01566f}, {0.02840f, 0.13383f, 0.83777f}}};
    constexpr Mat3 kOut = {{{1.60475f, -0.53108f, -0.07367f},
                            {-0.10208f, 1.10813f, -0.00605f},
                            {-0.00327f, -0.07276f, 1.07602f}}};
    const Vec3 fitted = each(kIn * c, [](float x) {
        return (x * (x + 0.0245786f) - 0.000090537f) / (x * (0.983729f * x + 0.4329510f) + 0.238081f);
    });
    return each(kOut * fitted, clamp_display);
}

// Khronos PBR Neutral specification. 0.04 is the reflectance at normal incidence of common dielectrics, which
// a renderer has added to the base colour; 0.08 and 6.25 continue that offset quadratically to black.
Vec3 neutral(Vec3 c) {
    constexpr float kF0 = 0.04f, kStart = 0.8f - kF0, kDesaturation = 0.15f;
    const float least = std::min({c.x, c.y, c.z});
    const float offset = least < 2 * kF0 ? least - least * least / (4 * kF0) : kF0;
    c = c - Vec3{offset, offset, offset};
    const float peak = std::max({c.x, c.y, c.z});
    if (peak < kStart) return c;
    // Above the start the peak approaches 1 hyperbolically, with a continuous slope.
    constexpr float kRoom = 1.0f - kStart;
    const float new_peak = 1.0f - kRoom * kRoom / (peak + kRoom - kStart);
    const float towards_white = 1.0f - 1.0f / (kDesaturation * (peak - new_peak) + 1.0f);
    c = c * (new_peak / peak);
    return c * (1.0f - towards_white) + Vec3{new_peak, new_peak, new_peak} * towards_white;
}

}  // namespace

std::span<const std::string> tone_map_names() {
    static const std::array<std::string, 4> names = {"none", "hable", "aces", "pbr_neutral"};
    return names;
}

Result<ToneMap> parse_tone_map(std::string_view name) {
    const auto names = tone_map_names();
    const auto it = std::ranges::find(names, name);
    if (it == names.end()) return Error{unknown_name("tone map", name, names)};
    return ToneMap(it - names.begin());
}

Vec3 tone_map(ToneMap curve, Vec3 c_linear) {
    // NaN becomes 0; infinity becomes a number whose square is finite.
    const Vec3 c = each(c_linear, [](float x) { return x > 0.0f ? std::min(x, 1e15f) : 0.0f; });
    switch (curve) {
        case ToneMap::hable:
            return hable(c);
        case ToneMap::aces:
            return aces(c);
        case ToneMap::pbr_neutral:
            return neutral(c);
        case ToneMap::none:
            break;
    }
    return each(c, clamp_display);
}

Image tone_mapped(const Image& image, ToneMap curve, float exposure) {
    assert(image.channels >= 3);
    Image out = to_linear_float(image);
    const size_t channels = size_t(out.channels);
    parallel_for(out.pixel_count(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            float* texel = out.floats().data() + i * channels;
            const Vec3 c = tone_map(curve, Vec3{texel[0], texel[1], texel[2]} * exposure);
            texel[0] = c.x, texel[1] = c.y, texel[2] = c.z;
        }
    });
    return out;
}

}  // namespace dermis::inline image
