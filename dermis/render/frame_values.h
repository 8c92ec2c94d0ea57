#pragma once
// The values of a frame for the shaders, by the names of shaders/include/frame.glsl.

#include "dermis/gpu/executor.h"
#include "dermis/optics/gain_form.h"
#include "dermis/scene/scene.h"

namespace dermis::inline render {

struct FrameValueSettings {
    int width = 1024, height = 1024;
    int shadow_map_size = 2048;
    float penumbra_mm = 2;
    int environment_mip_count = 1;
    std::array<Vec3, 9> environment_sh = {};  ///< EnvironmentLight::radiance_sh
    GainForm gain;                            ///< of the skin
    Rgb slab_gain = {1, 1, 1};
};

/// Coefficients of shaders/include/frame.glsl's environment_terms: radiance from the directions of the world
/// as real spherical harmonics (orthonormal, order 00, 1-1, 10, 11, 2-2, 2-1, 20, 21, 22) in the environment,
/// which is turned by yaw_rad about y.
[[nodiscard]] std::array<Vec3, 9> environment_terms(const std::array<Vec3, 9>& sh, float yaw_rad);

/// The block Frame.
[[nodiscard]] gpu::Values frame_values(const Scene& scene, const FrameValueSettings& settings);

/// The buffer Lights, one element a light in the scene's order; never empty (a dark light if there is none).
[[nodiscard]] std::vector<gpu::Values> light_values(const Scene& scene);

/// From world mm to the key light's clip space: the frustum that just holds the bounding sphere, so that no
/// texel of the shadow map is wasted (parallel for a directional light, perspective otherwise).
[[nodiscard]] Mat4 light_matrix(const Light& light, Vec3 center_mm, float radius_mm);

}  // namespace dermis::inline render
