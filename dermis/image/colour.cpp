#include "dermis/image/colour.h"

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

}  // namespace dermis::inline image
