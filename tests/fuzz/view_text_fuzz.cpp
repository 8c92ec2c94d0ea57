// The texts that dermis view reads: a line from the clipboard, its state file, a scene file that it changes.
// Dictionary: dermis/view/view_line.cpp dermis/view/state_file.cpp dermis/scene/scene_tables.cpp

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "catalog/catalog.h"
#include "dermis/scene/load_scene.h"
#include "dermis/view/scene_edit.h"
#include "dermis/view/state_file.h"
#include "dermis/view/view_line.h"

using namespace dermis;
using namespace dermis::view;

namespace {

void expect(bool holds) {
    if (!holds) std::abort();
}

const DrawSettings kSize = {.width = 640, .height = 480};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const Scene kScene = *load_scene("builtin:spheres", {.subjects = built_in_catalog().subjects});
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    Scene scene = {.lights = kScene.lights, .camera = kScene.camera, .environment = kScene.environment};
    const Scene file = without_objects(scene);
    const Technique& technique = built_in_catalog().techniques.front();
    Model model{.scene_path = "a",
                .scene = &scene,
                .catalog = built_in_catalog(),
                .choices = {TechniqueChoice(technique), TechniqueChoice(technique)}};
    static const std::string kBefore = view_line(model, file, kSize);  // every input begins so
    const Result<void> taken = apply_view_line(model, text);
    const std::string after = view_line(model, file, kSize);
    if (!taken) {
        expect(after == kBefore && taken.error().message.find('\n') == std::string::npos);
    } else {
        // The written text is read again and gives the same.
        expect(apply_view_line(model, after).ok());
        const std::string rounded = view_line(model, file, kSize);
        expect(apply_view_line(model, rounded).ok() && view_line(model, file, kSize) == rounded);
    }

    const WindowState state = parse_state(text);
    expect(state.width >= 160 && state.height >= 160 && state.recent.size() <= kMaxRecent);
    const WindowState again = parse_state(state_text(state));
    expect(again.width == state.width && again.recent == state.recent);

    (void)edit_toml(text, {{"", "name", "\"c\""},
                           {"light", "yaw_deg", "7", 1},
                           {"camera", "target_mm", "[4, 5, 6]"},
                           {"camera", "eye_mm", ""},
                           {"skin", "profile", "\"x\""}});
    return 0;
}
