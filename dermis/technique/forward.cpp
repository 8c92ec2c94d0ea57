#include "dermis/technique/forward.h"

namespace dermis {
namespace {

int32_t view_constant(std::string_view view, std::string_view own_view) {
    if (view == "diffuse") return kViewDiffuse;
    if (view == "specular") return kViewSpecular;
    return !own_view.empty() && view == own_view ? kViewOwn : kViewFinal;
}

}  // namespace

const std::vector<std::string>& specular_model_names() {
    static const std::vector<std::string> kNames = {"none", "blinn_phong", "ggx", "two_lobe_ggx", "ksk"};
    return kNames;
}

Pass forward_skin_pass(std::string shader, SpecularModel specular, const FrameContext& frame,
                       std::string_view own_view) {
    return {
        .name = "skin",
        .kind = PassKind::geometry_screen,
        .shader = std::move(shader),
        .reads = {"shadow_map"},
        .colors = {{.image = "radiance", .load = LoadOp::load}},
        .depth = DepthTarget{.image = "depth", .load = LoadOp::load},
        .geometry = GeometryFilter::skin,
        .constants = {{"specular_model", int32_t(specular)}, {"view", view_constant(frame.view, own_view)}}};
}

}  // namespace dermis
