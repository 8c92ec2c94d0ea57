#include "dermis/image/colour.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dermis::inline image {

// CIE 15:2004, equations 8.3 to 8.11. The threshold (6/29)^3 and slope 841/108 are the exact fractions that
// make the linear toe meet the cube root with equal value and slope.
Vec3 lab_from_xyz(Vec3 xyz) {
    const auto f = [](float t) {
        return t > 216.0f / 24389.0f ? std::cbrt(t) : t * (841.0f / 108.0f) + 4.0f / 29.0f;
    };
    const float fx = f(xyz.x / kWhiteXyz.x), fy = f(xyz.y / kWhiteXyz.y), fz = f(xyz.z / kWhiteXyz.z);
    return {116.0f * fy - 16.0f, 500.0f * (fx - fy), 200.0f * (fy - fz)};
}

namespace {

// L*, a*, b* (D65).
constexpr std::array<Vec3, 6> kTones = {{{78.0f, 11.0f, 11.0f},
                                         {71.5f, 15.0f, 15.0f},
                                         {65.5f, 15.5f, 18.0f},
                                         {58.5f, 15.0f, 20.0f},
                                         {48.5f, 14.0f, 19.0f},
                                         {28.4f, 11.5f, 13.0f}}};

// CIE 15: the inverse of L* = 116 f(Y) - 16, a* = 500 (f(X) - f(Y)), b* = 200 (f(Y) - f(Z)).
Vec3 linear_from_lab(Vec3 lab) {
    constexpr Vec3 white = kWhiteXyz;
    const float y = (lab.x + 16) / 116;
    const auto inverse = [](float f) {
        constexpr float kKnee = 6.0f / 29;
        return f > kKnee ? f * f * f : 3 * kKnee * kKnee * (f - 4.0f / 29);
    };
    return kLinearFromXyz *
           Vec3{white.x * inverse(y + lab.y / 500), white.y * inverse(y), white.z * inverse(y - lab.z / 200)};
}

}  // namespace

Vec3 skin_tone_albedo_linear(double tone) {
    const double at = std::clamp(tone, 1.0, 6.0) - 1;
    const size_t i = std::min(size_t(at), kTones.size() - 2);
    return linear_from_lab(kTones[i] + (kTones[i + 1] - kTones[i]) * float(at - double(i)));
}

}  // namespace dermis::inline image
