#pragma once
// What the diffuse transport makes of the unit scenes, in closed form or by short sums. Lengths in mm; the
// light's irradiance on a surface that faces it is 1.

#include "dermis/scene/subject.h"

namespace dermis::unit {

/// A sphere around `center_mm`: the clamped cosine blurred by von Mises-Fisher lobes.
[[nodiscard]] ExactExitance exact_sphere(Vec3 center_mm, float radius_mm, Vec3 to_light);

/// An infinite cylinder around the Y axis, lit at a right angle to it. Along the axis a Gaussian integrates
/// to a constant, which leaves the ring with Gaussians normalised as lines.
[[nodiscard]] ExactExitance exact_cylinder(float radius_mm, Vec3 to_light);

/// The plane z = 0, in shadow where x < 0; only the strip |x| < half_width_mm is skin (infinity: all of it).
/// The edge of the shadow is as wide as a disk in the plane that is a circle of `penumbra_mm` seen from the
/// light; the light comes from the left or right.
[[nodiscard]] ExactExitance exact_shadow_edge(float half_width_mm, Vec3 to_light);

/// An infinite slab, lit from behind: all of the light on its front came through.
[[nodiscard]] ExactExitance exact_slab(float thickness_mm, Vec3 to_light);

/// A relief z = sin(2 pi x / wavelength) of this largest slope. A Gaussian damps each harmonic of the
/// irradiance by exp(-2 pi^2 v k^2 / wavelength^2): the limit of a small slope, in which the path along the
/// relief is as long as the distance along x.
[[nodiscard]] ExactExitance exact_relief(float wavelength_mm, float slope, Vec3 to_light);

}  // namespace dermis::unit
