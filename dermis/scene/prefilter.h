#pragma once
// A cube for GGX reflections: every level is the environment seen through the lobe of one roughness.
//
// The first factor of the split sum (Karis 2013, "Real Shading in Unreal Engine 4"): normal, view and
// reflection are taken as one direction, samples follow the GGX normal distribution (Trowbridge, Reitz 1975;
// Walter et al. 2007) weighted by n.l. Each sample reads a mip whose texel covers the sample's share of the
// sphere (Krivanek, Colbert 2008, "Real-time Shading with Filtered Importance Sampling"), so few samples
// leave no noise.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dermis/scene/cube_map.h"

namespace dermis::inline scene {

/// All levels as EnvironmentLight::cube has them. Level m has roughness m / (mips - 1); level 0 is the
/// mirror. The weights of a level sum to 1, so a constant environment stays exactly constant. Deterministic.
[[nodiscard]] std::vector<std::byte> prefilter_ggx(const CubePyramid& environment, int base_size, int mips);

/// One lobe: what it reflects of the environment, by the direction of the normal, the view and the
/// reflection.
class PrefilteredLobe {
  public:
    /// Roughness 0 takes one sample, with the footprint of a texel of `mirror_texel_sr` steradians.
    PrefilteredLobe(const CubePyramid& environment, float roughness, uint32_t samples, float mirror_texel_sr);

    [[nodiscard]] Vec3 reflected(Vec3 n) const;

  private:
    struct Sample {
        Vec3 l;  ///< around +Z
        float weight = 0, level = 0;
    };

    const CubePyramid& environment_;
    std::vector<Sample> samples_;
};

/// Number of samples for the lobe of a mip level. Rough lobes are wider and take more.
[[nodiscard]] uint32_t prefilter_samples(int level);

/// Bytes of such a cube.
[[nodiscard]] size_t prefiltered_bytes(int base_size, int mips);

}  // namespace dermis::inline scene
