#pragma once
// Internal to preintegration: numbers of one von Mises lobe.

#include <cmath>
#include <numbers>

#include "dermis/optics/preintegration.h"

namespace dermis::inline optics::preintegration {

/// Below this concentration the Legendre or Fourier series is used (at most kMaxOrder of them), above it the
/// expansion about the terminator. Both are good to 1e-9 here, and the seam is a test.
inline constexpr double kSwitchConcentration = 64;
inline constexpr int kMaxOrder = 56;

/// mean_cosine: of the lobe, so that F(t) - F(-t) = mean_cosine * t. mass: of exp(-kappa (1 - cos x)), in the
/// measure that the construction's weights need: 1 - exp(-2 kappa) on the sphere (times 2 pi / kappa, which
/// the area of the Gaussian takes up), the integral over half the circle's span on the rings.
struct Lobe {
    double mean_cosine = 1;
    double mass = 1;
};
[[nodiscard]] Lobe lobe(Construction construction, double concentration);

/// Scaled Bessel functions exp(-kappa) I_0 and I_1 by their asymptotic series, for kappa >=
/// kSwitchConcentration; relative error below 1e-15.
[[nodiscard]] double scaled_bessel_i0(double concentration);
[[nodiscard]] double scaled_bessel_i1(double concentration);

/// Coefficient m of exp(-x) I_nu(x) = (2 pi x)^(-1/2) * sum_m c_m x^(-m) (DLMF 10.40.1).
[[nodiscard]] double bessel_asymptotic_coefficient(double nu, int m);

}  // namespace dermis::inline optics::preintegration
