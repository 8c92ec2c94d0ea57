#pragma once
// Tone mapping: scene light to display. Linear sRGB in, linear sRGB in 0..1 out; the sRGB
// encoding comes after. All curves map 0 to 0 and are monotone in grey.
//
//     none     clamps
//     hable    J. Hable, "Uncharted 2: HDR Lighting", GDC 2010: a rational curve with toe and shoulder, a
//              channel at a time (bright colours lose saturation)
//     aces     the ACES reference and sRGB output transforms as S. Hill fitted them (BakingLab, 2016): light
//              of 1 becomes 0.62 (0.81 encoded)
//     pbr_neutral  Khronos PBR Neutral (E. Malan, 2024): colours up to 0.8 lose only the Fresnel
//              reflection of 0.04, highlights are compressed; the one to judge skin albedo by

#include <span>
#include <string>

#include "dermis/base/result.h"
#include "dermis/base/vec.h"
#include "dermis/image/image.h"

namespace dermis::inline image {

enum class ToneMap { none, hable, aces, pbr_neutral };

/// "none", "hable", "aces", "pbr_neutral", in the order of the enumerators.
[[nodiscard]] std::span<const std::string> tone_map_names();
[[nodiscard]] Result<ToneMap> parse_tone_map(std::string_view name);

/// Negative components count as 0.
[[nodiscard]] Vec3 tone_map(ToneMap curve, Vec3 c_linear);

/// A picture of three or four channels, any format: `exposure` (2^EV) multiplies the light first, alpha is
/// kept. The result is f32 and linear.
[[nodiscard]] Image tone_mapped(const Image& image, ToneMap curve, float exposure = 1.0f);

}  // namespace dermis::inline image
