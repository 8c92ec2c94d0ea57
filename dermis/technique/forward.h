#pragma once
// Shared by techniques that shade in one forward pass; shaders/include/forward.glsl is the other half.

#include <string>

#include "dermis/technique/technique.h"
#include "shaders/include/constants.h"

namespace dermis::inline technique {

enum class SpecularModel : int32_t {
    none = kSpecularNone,
    blinn_phong = kSpecularBlinnPhong,
    ggx = kSpecularGgx,
    two_lobe_ggx = kSpecularTwoLobe,
    ksk = kSpecularKsk
};

[[nodiscard]] const std::vector<std::string>& specular_model_names();

/// For a pass whose shader calls light_through() of shaders/include/shadow.glsl: its reads and constants.
void read_shadows(Pass& pass, int shadow_map_count, bool has_translucent);

/// For a pass whose shader includes shaders/include/reduced_diffuse.glsl: how much of light `specular`
/// reflects, where the scene asks for it.
void reduce_diffuse(Pass& pass, SpecularModel specular, const FrameContext& frame);

/// "shadow_map" and "shadow_tint", or with _1, _2 ... behind.
[[nodiscard]] std::string shadow_image(std::string_view name, int index);

/// The skin drawn through the camera into radiance and depth. `own_view` is the technique's own debug view,
/// if it has one (shaders/include/view.glsl); views of the G-buffer shade as final.
[[nodiscard]] Pass forward_skin_pass(std::string shader, SpecularModel specular, const FrameContext& frame,
                                     std::string_view own_view = {});

}  // namespace dermis::inline technique
