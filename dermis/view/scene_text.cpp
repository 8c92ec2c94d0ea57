// The user's changes as edits of the scene file.

#include <algorithm>
#include <cctype>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/scene/scene_files.h"
#include "dermis/scene/scene_words.h"
#include "dermis/scene/toml_values.h"
#include "dermis/view/scene_edit.h"

namespace dermis::view {
namespace fs = std::filesystem;
namespace {

// The keys of a light that the window changes; a file's other keys are kept.
constexpr std::string_view kLightKeys[] = {"yaw_deg", "pitch_deg", "distance_mm", "intensity", "color"};

// Every key that can be changed of a loaded scene; of lights that are in the file, only the keys above.
void add_scene(std::vector<TomlEdit>& edits, const Scene& scene, bool lights_in_file) {
    for (const SceneKey& key : keys_of(scene)) {
        const std::string& name = key.info->name;
        if (key.section == "light" && lights_in_file &&
            (!scene.lights[size_t(key.light)].is_key || !std::ranges::count(kLightKeys, name)))
            continue;
        edits.push_back({key.section, name, toml_value(*key.info, key.value), key.light});
    }
    // Keys that cannot be combined with those.
    edits.push_back({"camera", "eye_mm", ""});
    if (scene.environment.kind != EnvironmentKind::file) edits.push_back({"environment", "file", ""});
    const auto key = std::ranges::find(scene.lights, true, &Light::is_key);
    if (key == scene.lights.end() || key->kind == LightKind::directional) return;
    for (const char* name : {"position_mm", "target_mm"})
        edits.push_back({"light", name, "", int(key - scene.lights.begin())});
}

// A key of [morph]: quoted where TOML needs it.
std::string target_key(const std::string& target) {
    const bool is_bare = !target.empty() && std::ranges::all_of(target, [](unsigned char c) {
        return (c < 128 && std::isalnum(c) != 0) || c == '_' || c == '-';
    });
    return is_bare ? target : toml_string(target);
}

// [animation] and [morph]; what is as it would be without a line has none. `file`: what the scene file
// states.
void add_motion(std::vector<TomlEdit>& edits, const MotionDescription& motion,
                const MotionDescription& file) {
    const MotionDescription none;
    const auto add = [&](const char* key, bool is_default, const std::string& value) {
        edits.push_back({"animation", key, is_default ? "" : value});
    };
    add("clip", motion.clip.empty(), toml_string(motion.clip));
    add("time_s", motion.time_s == none.time_s, to_text(motion.time_s));
    add("speed", motion.speed == none.speed, to_text(motion.speed));
    add("loop", !motion.loop, "true");
    for (const auto& [target, weight] : file.morph)
        if (!motion.morph.contains(target)) edits.push_back({"morph", target_key(target), ""});
    for (const auto& [target, weight] : motion.morph)
        edits.push_back({"morph", target_key(target), to_text(weight)});
}

// As in [settings]: a choice is a string, a toggle true or false, a colour an array.
std::string setting_value(const Parameter& parameter, const ParameterValues& values) {
    const std::string text = values.text(parameter);
    switch (parameter.kind) {
        case ParameterKind::choice:
            return toml_string(text);
        case ParameterKind::toggle:
            return text == "on" ? "true" : "false";
        case ParameterKind::color:
            return "[" + text + "]";
        default:
            return text;
    }
}

void add_technique(std::vector<TomlEdit>& edits, Model& model) {
    TechniqueChoice& choice = model.choices[0];
    edits.push_back({"", "technique", toml_string(choice.technique().id)});
    for (const auto& [name, value] : model.scene->settings) edits.push_back({"settings", name, ""});
    const ParameterPreset* preset = choice.values().preset();
    const bool named = preset && preset->name != "default";
    edits.push_back({"settings", "preset", named ? toml_string(preset->name) : ""});
    const ParameterValues defaults(choice.technique().parameters);
    for (const Parameter& parameter : choice.technique().parameters.parameters) {
        const bool same = named || choice.values().get(parameter) == defaults.get(parameter);
        edits.push_back({"settings", parameter.name, same ? "" : setting_value(parameter, choice.values())});
    }
}

std::string empty_lights(const Scene& scene) {
    std::string text;
    for (size_t i = 0; i < scene.lights.size(); ++i) text += "\n[[light]]\n";
    return text;
}

// For a mesh or a built-in: a scene file with this mesh and all lights of the studio.
std::string new_scene(const Model& model) {
    const std::string& path = model.scene_path;
    const bool is_file = !path.starts_with("builtin:");
    return "name = " + toml_string(model.scene->name) +
           "\n\n[[mesh]]\nfile = " + toml_string(is_file ? fs::absolute(path).string() : path) + "\n" +
           empty_lights(*model.scene);
}

// Makes the file's relative paths absolute.
std::string with_absolute_paths(std::string text, const SceneDescription& scene) {
    for (const NamedFile* named : named_files(scene)) {
        const NamedFile& file = *named;
        if (file.text.find(':') != std::string::npos || fs::path(file.text).is_absolute()) continue;
        const fs::path absolute = fs::absolute(scene.file).parent_path() / file.text;
        for (const char quote : {'"', '\''}) {
            const std::string old = quote + file.text + quote;
            for (size_t at = 0; (at = text.find(old, at)) != text.npos;) {
                const std::string fresh = toml_string(absolute.lexically_normal().string());
                text.replace(at, old.size(), fresh);
                at += fresh.size();
            }
        }
    }
    return text;
}

fs::path scene_file_of(const std::string& path_or_name) {
    if (to_lower(fs::path(path_or_name).extension().string()) == ".toml") return path_or_name;
    return find_scene(path_or_name);
}

}  // namespace

Result<std::string> scene_text(Model& model, const fs::path& directory) {
    const fs::path file = scene_file_of(model.scene_path);
    std::string text;
    bool lights_in_file = false;
    MotionDescription motion_in_file;
    if (file.empty()) {
        text = new_scene(model);
    } else {
        DERMIS_TRY_ASSIGN(const std::string old, read_text_file(file));
        const Result<SceneDescription> scene = parse_scene(old, file, model.catalog.subjects);
        if (!scene) return scene.error();
        std::error_code ec;
        const bool same_place = fs::equivalent(fs::absolute(file).parent_path(), directory, ec);
        text = same_place ? old : with_absolute_paths(old, *scene);
        lights_in_file = !scene->lights.empty();
        motion_in_file = scene->motion;
        if (!lights_in_file) text += empty_lights(*model.scene);  // the studio's
    }
    std::vector<TomlEdit> edits;
    add_technique(edits, model);
    add_scene(edits, *model.scene, lights_in_file);
    add_motion(edits, model.scene->motion, motion_in_file);
    const std::string edited = edit_toml(text, edits);
    if (const Result<SceneDescription> read = parse_scene(edited, file, model.catalog.subjects); !read)
        return Error{"this scene file is written in a way that cannot be changed in place: " +
                     read.error().message};
    return edited;
}

}  // namespace dermis::view
