#pragma once
// Textures for blurs over the skin's atlas, made from the scene's meshes.

#include <vector>

#include "dermis/gpu/device.h"
#include "dermis/rays/diffused_normals.h"
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
    float light_map_scale = 1;    ///< FrameContext::light_map_scale
};
[[nodiscard]] UvDensity uv_density(const Scene& scene);

// Baked normals as the textures that a shader reads: ten bytes a texel instead of sixteen.

/// The textures of kDiffusedNormalsTextures (optics/diffused_normals.h) with all mip levels. A mean is
/// kept as its direction and sqrt(1 - its length), since the length of a vector of 8 or 10 bits would say
/// nothing of the curvature of a head: 1 - length is 5e-4 at a radius of 50 mm. Levels are means of the
/// vectors of the skin in them, so that bumps that a level no longer shows are in its length. Errors: .001 of
/// each part of red's direction, .004 sqrt(x) of what green's differs from it, x, .002 of sqrt(1 - length).
[[nodiscard]] std::vector<gpu::TextureData> diffused_normals_textures(const DiffusedNormals& normals);

}  // namespace dermis::inline render
