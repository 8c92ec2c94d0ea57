// Scene files from anywhere: parsing is a scene or one line that starts with the file's name; it never
// crashes, and touches no file. Views as texts, the other thing people type, ride along.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "catalog/catalog.h"
#include "dermis/scene/scene_description.h"

namespace {

void expect(bool holds) {
    if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const dermis::Result<dermis::SceneDescription> scene =
        dermis::parse_scene(text, "fuzz.toml", dermis::built_in_catalog().subjects);
    if (scene) {
        expect(!scene->meshes.empty());
        int keys = 0;
        for (const dermis::LightDescription& light : scene->lights) keys += light.key.value_or(false);
        expect(scene->lights.empty() || keys == 1);
    } else {
        expect(scene.error().message.starts_with("fuzz.toml:"));
        expect(scene.error().message.find('\n') == std::string::npos);
    }
    if (const auto camera = dermis::parse_camera(text, dermis::Camera{}))
        expect(dermis::parse_camera(dermis::camera_text(*camera), *camera).ok());
    dermis::Scene look;
    if (dermis::parse_look(text, look)) {
        const dermis::Scene plain;
        dermis::Scene again;
        expect(dermis::parse_look(dermis::look_text(look, plain), again).ok());
    }
    return 0;
}
