#pragma once
// Order-2 spherical harmonics of radiance.
//
// Real orthonormal basis without the Condon-Shortley sign, in the order (l, m) = 00, 1-1, 10, 11, 2-2, 2-1,
// 20, 21, 22 and with Y up as a plain axis: y, z, x for l = 1 and xy, yz, 3z^2 - 1, xz, x^2 - y^2 for l = 2
// (Ramamoorthi, Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps", equations 3 and
// 9).

#include <array>

#include "dermis/base/vec.h"
#include "dermis/image/image.h"

namespace dermis::inline scene {

/// Linear red, green, blue of each coefficient.
using RadianceSh = std::array<Vec3, 9>;

/// The nine basis functions at a unit direction.
[[nodiscard]] std::array<float, 9> sh_basis(Vec3 d);

/// Integral of radiance times basis over the sphere, exact solid angle a row. A constant 1 gives 2 sqrt(pi)
/// in the first coefficient.
[[nodiscard]] RadianceSh project_radiance(const Image& panorama);

/// Irradiance on a surface with normal n: band weights pi, 2 pi / 3, pi / 4 (same source, equation 9). For
/// distant lighting within 9 % of the true irradiance whatever the environment (their appendix); may
/// be slightly negative opposite a single small light.
[[nodiscard]] Vec3 sh_irradiance(const RadianceSh& sh, Vec3 n);

}  // namespace dermis::inline scene
