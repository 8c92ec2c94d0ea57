#pragma once
// Pre-integrated diffuse light without a two-dimensional table: a straight line and a hyperbola in N.L, whose
// five coefficients a colour are functions of curvature alone.
//
// The clamped cosine is t/2 + |t|/2 and the scattering lobe is symmetric, so D(t) = (A t + E(t)) / 2 with A
// exact and E even: a blurred |t|. A profile is narrow and wide Gaussians at once; the narrow ones round
// the corner at the terminator, as a hyperbola does, the wide ones add a curve like a parabola:
//
//     E(t) = s sqrt(q^2 + t^2) + k0 + k1 t^2
//
// s, k0, k1 by least squares, q by search. Measured against the integral, GPU Gems 3 skin on the sphere, all
// r from 1 mm: 0.0017 at most, less than half of an 8-bit code (tests/optics/closed_form_test.cpp).

#include <vector>

#include "dermis/base/result.h"
#include "dermis/optics/preintegration.h"

namespace dermis::inline optics {

/// At one curvature, red, green, blue. Flat skin: a = s = 1, the others 0.
struct ClosedFormCoefficients {
    Rgb a, q, s, k0, k1;
};

struct ClosedForm {
    double max_curvature_per_mm = 0.5;
    std::vector<ClosedFormCoefficients>
        rows;              ///< even steps of curvature from 0 to the maximum, both included
    double max_error = 0;  ///< against the integral, at the fitted curvatures over all N.L
};

/// Errors: what check_preintegrable refuses, fewer than 2 rows, a curvature that is not positive. About 0.5
/// ms a row.
[[nodiscard]] Result<ClosedForm> fit_closed_form(const GaussianSum& profile, double max_curvature_per_mm,
                                                 int row_count, const Preintegration& how = {});

/// D(n_dot_l) from the fit, rows interpolated linearly as a texture unit does; larger curvatures are the
/// largest.
[[nodiscard]] Rgb evaluate(const ClosedForm& form, double n_dot_l, double curvature_per_mm);

}  // namespace dermis::inline optics
