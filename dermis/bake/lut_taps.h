#pragma once
// The published loops, unchanged: for reproducing old tables, never for new ones.

#include <span>
#include <vector>

#include "dermis/bake/table.h"
#include "dermis/optics/profile.h"

namespace dermis::inline bake {

/// Interleaved RGB, one row of n_dot_l a radius (finite, mm). unity_taps: a = -pi/2, -pi/2 + 0.05, ... up to
/// pi/2, the profile at the chord 2 r |sin(a/2)| as one-dimensional Gaussians, divided by the sum of weights
/// ("Pre-Integrated Skin Shading" for Unity 3.5, 2011). faceworks_taps: 200 midpoints over arc lengths of
/// min(pi r, 10 mm) to both sides, the profile at the arc length, not divided (NVIDIA FaceWorks 1.0, 2016;
/// its standard deviations are rounded to three digits there). Error: the profile is not a sum of Gaussians.
[[nodiscard]] Result<std::vector<float>> integrate_by_taps(const Profile& profile, Integration integration,
                                                           std::span<const double> n_dot_l,
                                                           std::span<const double> radii_mm,
                                                           const Preintegration& how);

/// integrate_rows or integrate_by_taps, as `integration` says.
[[nodiscard]] Result<std::vector<float>> integrate_model(const Profile& profile, Integration integration,
                                                         std::span<const double> n_dot_l,
                                                         std::span<const double> radii_mm,
                                                         const Preintegration& how);

}  // namespace dermis::inline bake
