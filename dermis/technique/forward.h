#pragma once
// What techniques that shade in one forward pass share (shaders/include/forward.glsl is the other half).

#include <string>

#include "dermis/technique/technique.h"

namespace dermis {

/// The order is that of shaders/include/specular.glsl.
enum class SpecularModel : int32_t { none, blinn_phong, ggx, two_lobe_ggx, ksk };

[[nodiscard]] const std::vector<std::string>& specular_model_names();

/// 0 final, 1 diffuse, 2 specular: the `view` constant of forward.glsl; other views shade as final.
[[nodiscard]] int32_t forward_view(std::string_view view);

/// The skin drawn through the camera into radiance and depth.
[[nodiscard]] Pass forward_skin_pass(std::string shader, SpecularModel specular, const FrameContext& frame);

}  // namespace dermis
