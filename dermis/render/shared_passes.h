#pragma once
// The passes around a technique: shadow map, background, what is not skin, G-buffer, resolve, tone map.

#include "dermis/scene/scene.h"
#include "dermis/technique/technique.h"

namespace dermis::inline render {

struct SharedPassSettings {
    int samples = 1;
    int shadow_map_size = 2048;
    std::vector<int> shadow_lights;  ///< beside the key light, by their maps: index into Scene::lights
    bool deep = false;               ///< radiance and display in 32-bit float
    ToneMap tone_map = ToneMap::hable;
    std::string view =
        "final";  ///< final, diffuse, specular, one of the technique's, or one of gbuffer_views()
    bool has_other = false, has_blended = false, has_translucent = false;
    bool has_cut_outs = false;  ///< alpha maps cut some of `other` out
    bool gbuffer = false;
    bool has_tension = false;  ///< the geometries have a stream "tension"
};

/// Names of the G-buffer's images: gbuffer_position, gbuffer_normal, gbuffer_geometry, gbuffer_albedo,
/// gbuffer_light.
[[nodiscard]] const std::vector<std::string>& gbuffer_images();

/// The view of the tension, which takes the place of the curvature in gbuffer_normal.
inline constexpr std::string_view kTensionView = "tension";

/// Debug views that every technique has: what the G-buffer holds.
[[nodiscard]] const std::vector<std::string>& gbuffer_views();

/// final, diffuse, specular, the technique's own views, and those of the G-buffer.
[[nodiscard]] std::vector<std::string> view_names(const Technique& technique);

/// The whole frame: shared passes with the technique's own in their place. Results: "radiance" (or
/// "radiance_resolved" when samples > 1) and "display", the sRGB-encoded picture.
[[nodiscard]] PassList frame_passes(const PassList& technique, const SharedPassSettings& settings);

/// The image of frame_passes() that holds the linear result.
[[nodiscard]] std::string radiance_image(const SharedPassSettings& settings);

/// The inputs of a list beside its own images: shared_inputs() plus the technique's tables.
/// "no_image" is one white texel, for textures that a shader has but, by its constants, never reads.
[[nodiscard]] std::vector<std::string> shared_inputs();

}  // namespace dermis::inline render
