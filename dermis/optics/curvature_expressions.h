#pragma once
// Pre-integrated light without any table: the coefficients of the closed form (optics/closed_form.h) and the
// zonal harmonics as polynomials, for shaders that are short of textures. With the curvature k per mm,
//
//     u = k (1 + c) / (k + c),   c = kCurvatureKnee
//     a = 1 + p_a(u),  s = 1 + p_s(u),  k0 = p_k0(u),  k1 = p_k1(u),  q = k (q_0 + q_1 u)
//     zh_l = Lambert's + p_l(u)
//
// where each p(u) = u (p_0 + p_1 u + ... + p_5 u^5) is 0 on flat skin, which is Lambert's exactly. A wide
// profile changes most at small curvatures, where u rises faster than k.
//
// The polynomials are fitted to the integral, not to the closed form's rows: for a given q the light is
// linear in all other coefficients, so that the two of q are searched and the rest are least squares.
// Measured against the integral, all presets, r from 1 mm: 0.0033 at most for the sphere, which is below one
// 8-bit code (tests/optics/curvature_expressions_test.cpp).

#include "dermis/base/result.h"
#include "dermis/optics/preintegration.h"

namespace dermis::inline optics {

inline constexpr size_t kExpressionTerms = 6;
inline constexpr double kCurvatureKnee = 0.5;

/// p_0 to p_5, red, green, blue.
using CurvaturePolynomial = std::array<Rgb, kExpressionTerms>;

struct CurvatureExpressions {
    CurvaturePolynomial a = {}, s = {}, k0 = {}, k1 = {};
    std::array<Rgb, 2> q = {};
    std::array<CurvaturePolynomial, 3> zonal = {};
    double max_error = 0;  ///< of the light, against the integral at the fitted curvatures, over all N.L
    double max_zonal_error = 0;  ///< of a harmonic
};

/// For curvatures from 0 to 1 per mm. Errors: what check_preintegrable refuses. About 50 ms.
[[nodiscard]] Result<CurvatureExpressions> fit_curvature_expressions(const GaussianSum& profile,
                                                                     const Preintegration& how = {});

/// D(n_dot_l); curvatures above 1 per mm are 1.
[[nodiscard]] Rgb evaluate(const CurvatureExpressions& form, double n_dot_l, double curvature_per_mm);
[[nodiscard]] std::array<Rgb, 3> evaluate_zonal(const CurvatureExpressions& form, double curvature_per_mm);

}  // namespace dermis::inline optics
