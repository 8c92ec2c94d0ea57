#pragma once
// A shadow's edge as an expression: light L over visibility v, symmetric about (1/2, 1/2), 0 and 1 at its
// ends. With y = 2 v - 1,
//
//     2 L - 1 = e_0 y + e_1 y^3 + e_2 y^5 + e_3 y sqrt(1 - y^2) + e_4 y / sqrt(y^2 + w_0^2) + e_5 y /
//     sqrt(y^2 + w_1^2)
//
// two hyperbolas for the narrow and the wide light of a profile, and a root for the ends, where the share of
// a disk starts with a vertical tangent. The e are least squares, the two widths searched.

#include <array>
#include <span>

#include "dermis/optics/preintegration.h"

namespace dermis::inline optics {

inline constexpr size_t kEdgeTerms = 6;

struct EdgeExpression {
    std::array<Rgb, kEdgeTerms> weight = {};
    std::array<Rgb, 2> width = {};
    double max_error = 0;  ///< of L, at the values that were fitted
};

/// `light`: L at even steps of visibility, both ends included; at least 9.
[[nodiscard]] EdgeExpression fit_edge_expression(std::span<const Rgb> light);

/// L; visibilities outside 0..1 are clamped.
[[nodiscard]] Rgb evaluate(const EdgeExpression& edge, double visibility);

}  // namespace dermis::inline optics
