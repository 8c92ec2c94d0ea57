#pragma once
// The tables with which the shader samples a profile.

#include <array>
#include <vector>

#include "dermis/optics/profile.h"

namespace dermis::screen_space_burley {

/// Three channels and their mean, as a texel.
using Texel = std::array<float, 4>;

/// The radius within which 99.7 % of the light leaves in every channel, in mm; 1 for a profile without width.
[[nodiscard]] double reach_mm(const Profile& profile);

/// 2 pi r R(r) over the albedo, 1/mm, at r = reach (i / (count - 1))^2, scaled so that each channel
/// integrates to 1 within the reach. A channel without reflectance has 0 everywhere.
[[nodiscard]] std::vector<Texel> radial_density(const Profile& profile, double reach_mm, int count);

/// The part of the light that leaves within the same radii.
[[nodiscard]] std::vector<Texel> part_within(const Profile& profile, double reach_mm, int count);

/// The radius in mm within which the part i / (count - 1) of the light leaves, in the mean of the channels.
[[nodiscard]] std::vector<float> radius_of_part(const Profile& profile, double reach_mm, int count);

}  // namespace dermis::screen_space_burley
