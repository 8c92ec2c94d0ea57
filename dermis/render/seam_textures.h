#pragma once
// What blurs over the skin's atlas need to know of it, made of the scene's meshes.

#include "dermis/gpu/device.h"
#include "dermis/scene/scene.h"
#include "dermis/technique/pass_list.h"

namespace dermis {

struct SeamTextures {
    SeamRequest request;
    gpu::Texture seam_map, chart_map;
};

/// Of all skin of the scene, which shares one atlas. See SeamRequest for what the texels mean.
[[nodiscard]] Result<SeamTextures> make_seam_textures(gpu::Device& device, const Scene& scene,
                                                      const SeamRequest& request);

/// Longest step in UV that a millimetre on the skin takes, in 99 % of its area; 0 for skin without UVs.
[[nodiscard]] float densest_uv_per_mm(const Scene& scene);

}  // namespace dermis
