#pragma once
// A cube for GGX reflections: every level is the environment seen through the lobe of one roughness.
//
// The first factor of the split sum (Karis 2013, "Real Shading in Unreal Engine 4"): normal, view and
// reflection are taken as one direction, samples follow the GGX normal distribution (Trowbridge, Reitz 1975;
// Walter et al. 2007) weighted by n.l. Each sample reads a mip whose texel covers the sample's share of the
// sphere (Krivanek, Colbert 2008, "Real-time Shading with Filtered Importance Sampling"), so few samples
// leave no noise.

#include <cstddef>
#include <vector>

#include "dermis/scene/cube_map.h"

namespace dermis::inline scene {

/// All levels as EnvironmentLight::cube has them. Level m has roughness m / (mips - 1); level 0 is the
/// mirror. The weights of a level sum to 1, so a constant environment stays exactly constant. Deterministic.
[[nodiscard]] std::vector<std::byte> prefilter_ggx(const CubePyramid& environment, int base_size, int mips);

/// Bytes of such a cube.
[[nodiscard]] size_t prefiltered_bytes(int base_size, int mips);

}  // namespace dermis::inline scene
