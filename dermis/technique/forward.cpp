#include "dermis/technique/forward.h"

namespace dermis {

const std::vector<std::string>& specular_model_names() {
    static const std::vector<std::string> kNames = {"none", "blinn_phong", "ggx", "two_lobe_ggx", "ksk"};
    return kNames;
}

int32_t forward_view(std::string_view view) {
    if (view == "diffuse") return 1;
    if (view == "specular") return 2;
    return 0;
}

Pass forward_skin_pass(std::string shader, SpecularModel specular, const FrameContext& frame) {
    return {.name = "skin",
            .kind = PassKind::geometry_screen,
            .shader = std::move(shader),
            .reads = {"shadow_map"},
            .colors = {{.image = "radiance", .load = LoadOp::load}},
            .depth = DepthTarget{.image = "depth", .load = LoadOp::load},
            .geometry = GeometryFilter::skin,
            .constants = {{"specular_model", int32_t(specular)}, {"view", forward_view(frame.view)}}};
}

}  // namespace dermis
