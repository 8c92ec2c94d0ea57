// Scene files: parsing gives a scene or one line that starts with the file's name; it never crashes and opens
// no file. The short texts of cameras and lights are tested too.
// Dictionary: dermis/scene/scene_tables.cpp dermis/scene/scene_words.cpp dermis/scene/scene_file.cpp
// subjects/*/params.cpp subjects/*/subject.cpp

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "catalog/catalog.h"
#include "dermis/scene/scene_description.h"
#include "dermis/scene/scene_words.h"

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
    if (const auto word = dermis::parse_scene_word(text)) {
        dermis::Scene seen{.lights = {{.is_key = true}}};
        if (dermis::set_words(seen, std::span(&*word, 1))) {
            dermis::Scene again{.lights = {{.is_key = true}}};
            expect(dermis::set_words(again, dermis::words_of(seen)).ok());
        }
        dermis::SceneDescription any{.meshes = {{}}};
        (void)dermis::set_word(any, *word, dermis::built_in_catalog().subjects);
    }
    dermis::Scene seen;
    if (dermis::set_section(seen, "camera", text)) {
        dermis::Scene again;
        expect(dermis::set_section(again, "camera", dermis::camera_text(seen.camera)).ok());
    }
    return 0;
}
