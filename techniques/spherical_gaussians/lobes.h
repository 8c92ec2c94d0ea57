#pragma once
// The profile as a few Gaussians a channel.

#include "dermis/optics/gaussian_channels.h"

namespace dermis::spherical_gaussians {

/// What a Gaussian keeps of the two that it replaces, besides their weight.
enum class Width : int32_t {
    deviation,  ///< mean standard deviation
    variance
};

/// `count` Gaussians at most in each channel, whose weights sum to 1. Neighbours in width are replaced by one
/// until no more are left, first those that lose least. On gently curved skin the light at the terminator is
/// sum w sqrt(v / 2 pi) / r, which Width::deviation keeps; Width::variance keeps the mean cosine of the lobes
/// instead, and reaches too far. A channel without reflectance has one Gaussian of no width that matters.
[[nodiscard]] std::vector<ChannelGaussians> lobes_of(const GaussianSum& profile, int count, Width width);

}  // namespace dermis::spherical_gaussians
