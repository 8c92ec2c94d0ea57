#pragma once
// The profile as a few Gaussians a channel, for shaders that take a lobe of light for each (Pettineo 2020).

#include <vector>

#include "dermis/optics/preintegration.h"

namespace dermis::inline optics {

/// A Gaussian with a variance of its own in each channel, as shaders evaluate a sum: one vector operation for
/// red, green and blue. Weight 0 where a channel has fewer Gaussians than another; its variance is then 1.
struct ChannelGaussians {
    Rgb weight = {0, 0, 0}, variance_mm2 = {1, 1, 1};
};

/// The same sum, each channel's Gaussians from narrow to wide. A fit has Gaussians of its own in each
/// channel (gaussian_fit.h): 18 terms become 6.
[[nodiscard]] std::vector<ChannelGaussians> by_channel(const GaussianSum& sum);

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
