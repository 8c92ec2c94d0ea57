#pragma once
// Textures for blurs over the skin's atlas, made from the scene's meshes.

#include "dermis/gpu/device.h"
#include "dermis/scene/scene.h"
#include "dermis/technique/pass_list.h"

namespace dermis::inline render {

struct SeamTextures {
    SeamRequest request;
    gpu::Texture seam_map, chart_map;
};

/// Textures of all skin of the scene, which shares one atlas. SeamRequest describes the texels.
[[nodiscard]] Result<SeamTextures> make_seam_textures(gpu::Device& device, const Scene& scene,
                                                      const SeamRequest& request);

/// Steps in UV that a millimetre on the skin takes; 0 for skin without UVs.
struct UvDensity {
    float densest_uv_per_mm = 0;  ///< the longest, in 99 % of the skin's area
    float typical_uv_per_mm = 0;  ///< median by area of the mean over all directions
};
[[nodiscard]] UvDensity uv_density(const Scene& scene);

}  // namespace dermis::inline render
