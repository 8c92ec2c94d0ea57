#pragma once
// The profile as a few Gaussians a channel, for shaders that take a lobe of light for each (Pettineo 2020).

#include "dermis/optics/gaussian_channels.h"

namespace dermis::inline optics {

/// The quantity that a merged Gaussian preserves, besides the weight.
enum class LobeWidth : int32_t {
    deviation,  ///< mean standard deviation
    variance
};

/// At most `count` Gaussians per channel, with weights that sum to 1. Merges neighbours in width, those that
/// lose least first. On gently curved skin the light at the terminator is sum w sqrt(v / 2 pi) / r, which
/// LobeWidth::deviation preserves; LobeWidth::variance preserves the mean cosine of the lobes and reaches too
/// far. A channel without reflectance has one Gaussian.
[[nodiscard]] std::vector<ChannelGaussians> lobes_of(const GaussianSum& profile, int count, LobeWidth width);

/// How far the light of the lobes is at most from that of the profile, both integrated over spheres of
/// least_radius_mm and more: what the merging costs.
[[nodiscard]] double merging_error(const GaussianSum& profile, const std::vector<ChannelGaussians>& lobes,
                                   double least_radius_mm);

/// Largest error that the irradiance of a lobe in shaders/include/skin/spherical_gaussians.glsl adds.
inline constexpr double kLobeLightError = 0.018;

}  // namespace dermis::inline optics
