#include "dermis/technique/screen_light.h"

namespace dermis::inline technique {

void add_screen_light(PassList& list, SpecularModel specular, const FrameContext& frame) {
    list.images.push_back({.name = "skin_light", .format = ImageFormat::rgba16f});
    list.images.push_back({.name = "skin_z", .format = ImageFormat::r32f});
    list.images.push_back({.name = "skin_key_visibility", .format = ImageFormat::r16f});
    list.images.push_back({.name = "skin_depth", .format = ImageFormat::depth32f});
    Pass light = {.name = "skin light",
                  .kind = PassKind::geometry_screen,
                  .shader = "screen/light.frag",
                  .colors = {{.image = "skin_light"}, {.image = "skin_z"}, {.image = "skin_key_visibility"}},
                  .depth = DepthTarget{.image = "skin_depth"},
                  .geometry = GeometryFilter::skin};
    reduce_diffuse(light, specular, frame);
    read_shadows(light, frame.shadow_map_count, frame.has_translucent);
    list.passes.push_back(std::move(light));
}

void add_screen_skin(PassList& list, const std::string& blurred, SpecularModel specular, BeyondBlur beyond,
                     const FrameContext& frame, std::string_view own_view) {
    Pass skin = forward_skin_pass("screen/final.frag", specular, frame, own_view);
    skin.reads.push_back({"blurred_light", blurred});
    skin.reads.push_back("skin_z");
    skin.reads.push_back("skin_key_visibility");
    read_transmission(skin, beyond.transmission, frame);
    use_gain(skin, beyond.gain);
    list.passes.push_back(std::move(skin));
}

}  // namespace dermis::inline technique
