#pragma once
// Light from the environment, prepared for shading: order-2 spherical harmonics of its radiance and a cube
// prefiltered with GGX. Everything is in the environment's own frame; Environment::yaw_rad and intensity are
// applied where it is looked up.

#include <array>
#include <cstddef>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/image/image.h"
#include "dermis/scene/scene.h"
#include "dermis/scene/spherical_harmonics.h"

namespace dermis::inline scene {

/// Perceptual roughness r (alpha = r^2) lives at mip level r * (mips - 1).
struct EnvironmentLight {
    RadianceSh radiance_sh;
    int base_size = 1, mips = 1;
    /// rgba16f (alpha 1), mips large to small, faces +X -X +Y -Y +Z -Z inside each, rows top to bottom as
    /// Vulkan has them.
    std::vector<std::byte> cube;
};

inline constexpr int kEnvironmentBaseSize = 128;
inline constexpr int kEnvironmentMips = 6;  ///< 128 to 4 texels

/// World to environment space: the inverse of a turn about Y by yaw, which moves +Z towards +X.
[[nodiscard]] Vec3 to_environment(Vec3 d_world, float yaw_rad);

/// The same for many directions.
struct EnvironmentTurn {
    float cosine = 1, sine = 0;  ///< of its yaw
};
[[nodiscard]] Vec3 to_environment(Vec3 d_world, EnvironmentTurn turn);

/// The panorama behind an environment: f32, linear, 3 channels, at most 1024 x 512 (larger files are averaged
/// down), every value finite and not negative. kind none gives one black texel. Errors: the file cannot be
/// read, or is not twice as wide as high.
[[nodiscard]] Result<Image> load_panorama(const Environment& environment);

/// load_panorama() and bake_environment(), cached on disk by the content of the file. Cold about a
/// second of one core's time (all cores share it) for 1024 x 512 texels; warm a read of 1 MB. Errors as
/// load_panorama().
[[nodiscard]] Result<EnvironmentLight> prepare_environment(const Environment& environment);

/// The bake without the cache. `mips` levels from `base_size` on.
[[nodiscard]] EnvironmentLight bake_environment(const Image& panorama, int base_size = kEnvironmentBaseSize,
                                                int mips = kEnvironmentMips);

}  // namespace dermis::inline scene
