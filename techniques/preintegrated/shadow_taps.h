#pragma once
// Where shadow=gathered looks for the light around a point, and what each place counts in each channel.

#include <vector>

#include "dermis/optics/preintegration.h"

namespace dermis::preintegrated {

struct ShadowTap {
    Rgb weight = {};
    double penumbra_weight = 0;  ///< of the light at the point itself, whose shadow is filtered; 1 on average
    double radius_mm = 0;        ///< on the skin
};

/// kShadowGatherTaps of them, from the nearest to the farthest. Light of a penumbra whose disk is
/// kLightEdgeMm wide and that scatters by the profile comes to a point from around it as R convolved with
/// the disk has it. The taps are at even steps of that function's integral, in the channel that scatters
/// farthest, where each weight is 1; in the others, and for the disk alone, a weight is the quotient of the
/// functions. Gaussians narrower than a tap can see count as so wide.
[[nodiscard]] std::vector<ShadowTap> shadow_taps(const GaussianSum& profile);

/// A Gaussian of this variance along an axis, convolved with a disk, at a distance from the disk's middle:
/// per mm^2. Within 1e-6 of its largest value for radii of up to six standard deviations.
[[nodiscard]] double gaussian_over_disk(double variance_mm2, double disk_radius_mm, double distance_mm);

}  // namespace dermis::preintegrated
