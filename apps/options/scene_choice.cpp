#include "scene_choice.h"

#include <algorithm>

#include "catalog/catalog.h"
#include "dermis/base/text.h"
#include "dermis/scene/load_scene.h"
#include "dermis/scene/scene_files.h"

namespace dermis::cli {

Option* SceneChoice::add_to(Command& command) {
    add_options_to(command);
    return command.add_option("SCENE", name,
                              "scene file, mesh (.glb .gltf .obj), name of a scene, or builtin:NAME");
}

void SceneChoice::add_options_to(Command& command) {
    command
        .add_option(
            "--scene", words,
            "KEY=VALUE of the scene file, such as skin.profile=NAME or exposure_ev=0.5; may be repeated "
            "(dermis keys lists them)")
        ->allow_extra_args(false);
    command.add_option("--unit-mm", unit_mm, kUnitRangeMm,
                       "length of one unit of the mesh file in mm: 10 for centimetres (default: glTF 1000, "
                       "OBJ 1, or what makes a mesh file as tall as a head)");
    pose.add_to(command);
    command.add_option("--camera", camera,
                       "short for camera keys: \"yaw_deg=30 pitch_deg=5 distance_mm=600 fov_deg=30\"");
    command.add_option("--light", light,
                       "short for light.key keys: \"yaw_deg=-60 pitch_deg=20 intensity=3\"");
}

Result<std::vector<SceneWord>> SceneChoice::all_words() const {
    std::vector<SceneWord> all;
    for (const std::string& text : words) {
        Result<SceneWord> word = parse_scene_word(text);
        if (!word) return Error{"--scene: " + word.error().message};
        all.push_back(std::move(*word));
    }
    if (unit_mm > 0) all.push_back({.key = "mesh.unit_mm", .value = to_text(unit_mm)});
    DERMIS_TRY_ASSIGN(const std::vector<SceneWord> posed, pose.words());
    all.insert(all.end(), posed.begin(), posed.end());
    for (const auto& [section, text] : {std::pair("camera", &camera), std::pair("light.key", &light)}) {
        DERMIS_TRY_ASSIGN(std::vector<SceneWord> some, parse_section_words(section, *text));
        all.insert(all.end(), some.begin(), some.end());
    }
    return all;
}

std::vector<SceneWord> words_for(const std::vector<SceneWord>& words, bool loading) {
    std::vector<SceneWord> some;
    // A profile gives skin without a colour its own while it is loaded, and replaces that of a loaded scene.
    std::ranges::copy_if(words, std::back_inserter(some), [&](const SceneWord& word) {
        return is_loading_key(word.key) == loading || (loading && word.key == "skin.profile");
    });
    return some;
}

Result<void> keep_scene_files(const Scene& scene, const Result<FileUse>& files) {
    if (!files) return files.error();
    return check_outputs({.outputs = files->outputs, .inputs = files_of(scene)});
}

Result<void> change_scene(Scene& scene, const std::vector<SceneWord>& words) {
    DERMIS_TRY(set_words(scene, words));
    const Vec3 eye_mm = scene.camera.eye_mm;
    if (length(eye_mm - scene.camera.target_mm) > 0) return {};
    return Error{"camera.eye_mm and camera.target_mm are the same point, " + to_text(eye_mm.x) + " " +
                 to_text(eye_mm.y) + " " + to_text(eye_mm.z) +
                 ": the camera looks nowhere; move one of them"};
}

Result<Scene> SceneChoice::load(Scene* as_filed) const {
    DERMIS_TRY_ASSIGN(const std::vector<SceneWord> all, all_words());
    if (unit_mm > 0 && subject_name(name))
        return Error{"--unit-mm is for mesh files; " + name + " is in millimetres"};
    Result<Scene> scene =
        load_scene(name, {.subjects = built_in_catalog().subjects, .words = words_for(all, true)});
    if (!scene) return scene;
    if (as_filed) *as_filed = without_objects(*scene);
    DERMIS_TRY(change_scene(*scene, words_for(all, false)));
    return scene;
}

}  // namespace dermis::cli
