#pragma once
// The normal map of a material with its wrinkle maps, as mean_of_normal_map() of shaders/include/surface.glsl
// has it.

#include "dermis/mesh/material.h"
#include "dermis/rays/ray_scene.h"
#include "dermis/rays/texture.h"
#include "dermis/scene/wrinkles.h"

namespace dermis::inline rays {

/// Null or empty: the material has none.
struct NormalMaps {
    const Texture* normal = nullptr;
    const Texture* stretch = nullptr;
    const Texture* compress = nullptr;
    WrinkleWeights weights = {};
};

/// The mean of the normals in the footprint, in the space of the maps, shorter than 1 where they differ. The
/// wrinkle maps take the place of the normal map by their wrinkle_share(). Mixing the vectors themselves
/// keeps it a mean: mips of the maps mix to the mips of the mixture. `maps` has a normal map.
[[nodiscard]] Vec3 mapped_normal(const Material& material, const NormalMaps& maps,
                                 const SurfaceAttributes& at);

}  // namespace dermis::inline rays
