#pragma once
// A sum of Gaussians with a variance of its own in each channel, as shaders evaluate it: one vector operation
// for red, green and blue.

#include <vector>

#include "dermis/optics/preintegration.h"

namespace dermis::inline optics {

/// Weight 0 where a channel has fewer Gaussians than another; its variance is then 1.
struct ChannelGaussians {
    Rgb weight = {0, 0, 0}, variance_mm2 = {1, 1, 1};
};

/// The same sum, each channel's Gaussians from narrow to wide. A fit has Gaussians of its own in each
/// channel (gaussian_fit.h): 18 terms become 6.
[[nodiscard]] std::vector<ChannelGaussians> by_channel(const GaussianSum& sum);

}  // namespace dermis::inline optics
