#pragma once
// The gain of a curved place, in closed form: how much of uniform light skin of a mean curvature returns,
// over flat skin. docs/transport.md derives it from diffusion with an extrapolated boundary.

#include <span>

#include "dermis/optics/medium.h"

namespace dermis::inline optics {

/// With H the mean curvature in 1/mm, above 0 on convex skin, and v = H / sqrt(1 + h^2), where h = length H
/// on convex and kGainFold length H on concave skin:
///
///     gain(H) = 1 + slope v / (1 - bend v)
///
/// A ball-shaped cavity has v = H. Concave skin of a head is in folds, narrower than the ways of the light,
/// and loses less.
///
/// `slope` is the first order in curvature. Of all light that enters a body smaller than a path nothing is
/// absorbed: gain(infinity) = 1 / albedo, which sets `bend` by `slope` and `length`.
struct GainForm {
    Rgb slope_mm = {0, 0, 0}, length_mm = {0, 0, 0}, bend_mm = {0, 0, 0};
};

/// By the captured shares of heads in light to dark skin (docs/figures.md).
inline constexpr double kGainFold = 5;

/// 0 upwards. Walks in balls of 2 mm radius or more differ by 6 % at most (tested).
[[nodiscard]] double gain(const GainForm& form, int channel, double curvature_per_mm);

/// A gain measured at one curvature.
struct GainSample {
    double curvature_per_mm = 0;
    Rgb gain = {1, 1, 1};
};

/// Least squares over samples of balls and ball-shaped cavities, relative to the larger of 1 and the gain.
/// `albedo`: what flat skin returns of diffuse light that entered, 0..1; at 0 and 1 the gain is 1.
[[nodiscard]] GainForm fit_gain_form(std::span<const GainSample> samples, const Rgb& albedo);

/// The slope that diffusion predicts, in mm: 4 D / ((1 - r) (1 + z / L)^2 R) with D = 1 / (3 sigma_t'), L the
/// diffusion length, r the diffuse reflectance of the boundary from inside, z = 2 D (1 + r) / (1 - r) the
/// extrapolated boundary, R the albedo of the half-space. 7 % off walks at an albedo of .85, 13 % at .6;
/// darker skin, where most paths have few collisions, is not diffusive (tested).
[[nodiscard]] double diffusion_gain_slope_mm(const ScatteringMedium& medium, int channel,
                                             double half_space_albedo);

}  // namespace dermis::inline optics
