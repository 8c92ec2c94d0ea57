#pragma once
// Colour spaces: the sRGB transfer function, Rec. 709 luminance, CIE XYZ and L*a*b*, ACEScg to linear sRGB.
//
// "linear" means linear sRGB: Rec. 709 primaries, white D65, 1 = display white. Everything here is pure.

#include <cmath>

#include "dermis/base/vec.h"

namespace dermis::inline image {

/// IEC 61966-2-1:1999, the piecewise function (not a 2.2 power). [0,1] -> [0,1]; negative values follow the
/// linear segment, values above 1 the power, so that decode(encode(x)) = x everywhere.
inline float srgb_decode(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}
inline float srgb_encode(float linear) {
    return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}
inline Vec3 srgb_decode(Vec3 c) {
    return {srgb_decode(c.x), srgb_decode(c.y), srgb_decode(c.z)};
}
inline Vec3 srgb_encode(Vec3 c) {
    return {srgb_encode(c.x), srgb_encode(c.y), srgb_encode(c.z)};
}

/// Rec. 709 luminance weights (ITU-R BT.709-6, item 3.2): the Y row of the matrix below.
inline constexpr Vec3 kLuminanceWeights = {0.2126f, 0.7152f, 0.0722f};
constexpr float luminance(Vec3 c_linear) {
    return dot(c_linear, kLuminanceWeights);
}

/// A 3x3 matrix by rows.
struct Mat3 {
    Vec3 row[3];
    friend constexpr Vec3 operator*(const Mat3& m, Vec3 v) {
        return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
    }
};

/// By cofactors; the determinant must not be 0.
[[nodiscard]] constexpr Mat3 inverse(const Mat3& m) {
    const Vec3 a = m.row[0], b = m.row[1], c = m.row[2];
    const Vec3 columns[3] = {cross(b, c), cross(c, a), cross(a, b)};
    const float scale = 1 / dot(a, columns[0]);
    return {{Vec3{columns[0].x, columns[1].x, columns[2].x} * scale,
             Vec3{columns[0].y, columns[1].y, columns[2].y} * scale,
             Vec3{columns[0].z, columns[1].z, columns[2].z} * scale}};
}

/// Linear sRGB to CIE XYZ (Y = 1 for white) and back; from the primaries of BT.709 and D65 = (0.3127,
/// 0.3290). A test derives both from those chromaticities.
inline constexpr Mat3 kXyzFromLinear = {{{0.4123908f, 0.3575843f, 0.1804808f},
                                         {0.2126390f, 0.7151687f, 0.0721923f},
                                         {0.0193308f, 0.1191948f, 0.9505322f}}};
inline constexpr Mat3 kLinearFromXyz = {{{3.2409699f, -1.5373832f, -0.4986108f},
                                         {-0.9692436f, 1.8759675f, 0.0415551f},
                                         {0.0556301f, -0.2039770f, 1.0569715f}}};

inline constexpr Vec3 kWhiteXyz = kXyzFromLinear * Vec3{1, 1, 1};

/// ACEScg (AP1 primaries, white D60; SMPTE ST 2065-1, S-2014-004) to linear sRGB with the Bradford adaptation
/// of ACES to D65. White stays white (rows sum to 1); colours outside Rec. 709 come out negative.
inline constexpr Mat3 kLinearFromAcesCg = {{{1.7050510f, -0.6217921f, -0.0832589f},
                                            {-0.1302564f, 1.1408048f, -0.0105483f},
                                            {-0.0240034f, -0.1289690f, 1.1529723f}}};

/// CIE 1976 L*a*b* with the white of linear sRGB (1,1,1): L 0..100, a and b about -110..110 within sRGB.
[[nodiscard]] Vec3 lab_from_xyz(Vec3 xyz);
[[nodiscard]] inline Vec3 lab_from_linear(Vec3 c_linear) {
    return lab_from_xyz(kXyzFromLinear * c_linear);
}

/// Mean albedo of bare skin of tone 1 to 6 (clamped), linear sRGB; interpolated linearly in CIELAB.
/// Tones IV to VI have the lightness of OpenPBR's skin examples; I to III are darker, in even steps, because
/// those examples are lighter than faces. Hue and chroma follow measurements of faces (Xiao et al. 2017).
/// docs/bust.md has the table.
[[nodiscard]] Vec3 skin_tone_albedo_linear(double tone);

}  // namespace dermis::inline image
