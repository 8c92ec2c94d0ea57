#include "dermis/technique/forward.h"

namespace dermis::inline technique {
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

std::string shadow_image(std::string_view name, int index) {
    return std::string(name) + (index > 0 ? "_" + std::to_string(index) : "");
}

// Textures that no light uses must be bound to something too.
void read_shadows(Pass& pass, int shadow_map_count, bool has_translucent) {
    for (int i = 0; i < kMaxShadowMaps; ++i) {
        const bool exists = i < shadow_map_count;
        pass.reads.emplace_back(shadow_image("shadow_map", i), shadow_image("shadow_map", exists ? i : 0));
        pass.reads.emplace_back(shadow_image("shadow_tint", i),
                                exists && has_translucent ? shadow_image("shadow_tint", i) : "no_image");
    }
    pass.constants.emplace_back("tinted_shadows", int32_t(has_translucent));
    pass.constants.emplace_back("shadow_map_count", int32_t(shadow_map_count));
}

void reduce_diffuse(Pass& pass, SpecularModel specular, const FrameContext& frame) {
    pass.constants.emplace_back("specular_model", int32_t(specular));
    pass.constants.emplace_back("reduced_diffuse",
                                int32_t(frame.reduced_diffuse && specular != SpecularModel::none));
}

Pass forward_skin_pass(std::string shader, SpecularModel specular, const FrameContext& frame,
                       std::string_view own_view) {
    Pass pass = {.name = "skin",
                 .kind = PassKind::geometry_screen,
                 .shader = std::move(shader),
                 .colors = {{.image = "radiance", .load = LoadOp::load}},
                 .depth = DepthTarget{.image = "depth", .load = LoadOp::load},
                 .geometry = GeometryFilter::skin,
                 .constants = {{"view", view_constant(frame.view, own_view)}}};
    reduce_diffuse(pass, specular, frame);
    read_shadows(pass, frame.shadow_map_count, frame.has_translucent);
    return pass;
}

}  // namespace dermis::inline technique
