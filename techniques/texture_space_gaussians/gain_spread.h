#pragma once
// From how far the light of the gain comes (docs/transport.md). At a distance r from a point of mean
// curvature H the skin lies H r^2 / 2 beside the tangent plane, so to first order what curved skin returns
// beyond flat skin has the profile's distribution times r^2. Of a Gaussian of variance v that is a kernel of
// variance 2 v along each axis, so of a sum of Gaussians
//     variance = 2 sum w v^2 / sum w v.
// The blur has two images of the light, the profile's sum and the widest Gaussian: a mixture of both has this
// variance, or is the widest Gaussian where that is narrower.

#include "dermis/optics/profile.h"

namespace dermis::texture_space_gaussians {

/// Along one axis, in mm^2, a channel each; 0 where the profile has no width.
[[nodiscard]] Vec3 gain_variance_mm2(const GaussianSum& profile);

/// Share of the Gaussian of this variance in the light that gain - 1 multiplies, 0..1; the rest is light
/// blurred by the profile.
[[nodiscard]] Vec3 widest_share_of_gain(const GaussianSum& profile, double widest_variance_mm2);

}  // namespace dermis::texture_space_gaussians
