#pragma once
// Rows of pre-integrated light for any profile: what the tables, the zonal harmonics and the linter share.

#include <span>
#include <vector>

#include "dermis/bake/table.h"
#include "dermis/optics/profile.h"

namespace dermis::inline bake {

/// The radius that an axis value means: itself on "radius_mm", its reciprocal (infinite at 0) on
/// "curvature_per_mm".
[[nodiscard]] double radius_of(const TableAxis& axis, double value);

/// Errors: an axis other than those two, or bounds outside 0..1000 per mm, 0.001..1e6 mm.
[[nodiscard]] Result<void> check_curvature_axis(const TableAxis& axis);

/// Exact values, interleaved RGB, one row of n_dot_l a radius, in parallel. Gaussian sums take about 15
/// microseconds a row of 512; other profiles quadrature (sphere only), 20 microseconds a value, which is
/// cached on disk. Errors name what is wrong with the profile.
[[nodiscard]] Result<std::vector<float>> integrate_rows(const Profile& profile,
                                                        std::span<const double> n_dot_l,
                                                        std::span<const double> radii_mm,
                                                        const Preintegration& how);

/// The profile as the quadrature of optics/preintegration.h wants it.
[[nodiscard]] RadialProfile radial_profile(const Profile& profile);

/// Success when a profile can be integrated this way at all.
[[nodiscard]] Result<void> check_preintegrable(const Profile& profile, const Preintegration& how);

// The published loops, unchanged: for reproducing old tables, never for new ones.

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
