#pragma once
// Internal to preintegration: the even part of F as a short series, for lobes that are not narrow.

#include <array>
#include <span>

#include "dermis/optics/preintegration/lobe.h"

namespace dermis::inline optics::preintegration {

/// F(t, kappa) = mean_cosine * t / 2 + sum_k coefficient_k(kappa) basis_k(t), with the basis
///   sphere     P_0, P_2, P_4 ...                       (Legendre polynomials of t)
///   ring       cos 0b, cos 2b, cos 4b ...              (b = asin t, the elevation over the terminator)
///   half_ring  b sin b, cos 0b, cos 1b, cos 2b ...
[[nodiscard]] size_t basis_size(Construction construction);
void evaluate_basis(Construction construction, double t, std::span<double> values);

struct EvenSeries {
    std::array<double, kMaxOrder + 2> coefficient = {};
    size_t count = 0;  ///< the rest is below 1e-11
};
[[nodiscard]] EvenSeries even_series(Construction construction, double concentration);

/// Ratios I_n(kappa) / I_0(kappa), n = 0 .. values.size() - 1, or with half_orders I_{n+1/2} / I_{1/2}.
enum class BesselOrders { whole, half };
void bessel_ratios(BesselOrders orders, double concentration, std::span<double> values);

}  // namespace dermis::inline optics::preintegration
