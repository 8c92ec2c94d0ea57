// The user's changes as edits of the scene file.

#include <algorithm>
#include <cmath>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/scene/find_parts.h"
#include "dermis/scene/part_words.h"
#include "dermis/scene/scene_files.h"
#include "dermis/scene/scene_words.h"
#include "dermis/scene/skin_tone.h"
#include "dermis/scene/toml_values.h"
#include "dermis/view/scene_edit.h"

namespace dermis::view {
namespace fs = std::filesystem;
namespace {

// The keys of a light that the window changes; a file's other keys are kept.
constexpr std::string_view kLightKeys[] = {"yaw_deg", "pitch_deg", "distance_mm", "intensity", "color"};

// Of lights that are in the file, only the keys above; no angles of a cone where there is none.
bool is_saved(const SceneKey& key, const Scene& scene, bool lights_in_file) {
    if (key.section != "light") return true;
    const std::string& name = key.info->name;
    const Light& light = scene.lights[size_t(key.light)];
    if (lights_in_file) return light.is_key && std::ranges::count(kLightKeys, name) > 0;
    return light.kind == LightKind::spot || (name != "inner_angle_deg" && name != "outer_angle_deg");
}

// Every key that can be changed of a loaded scene.
void add_scene(std::vector<TomlEdit>& edits, const Scene& scene, bool lights_in_file) {
    for (const SceneKey& key : keys_of(scene)) {
        const std::string& name = key.info->name;
        if (!is_saved(key, scene, lights_in_file)) continue;
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
        if (!motion.morph.contains(target)) edits.push_back({"morph", toml_key(target), ""});
    for (const auto& [target, weight] : motion.morph)
        edits.push_back({"morph", toml_key(target), to_text(weight)});
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

// [[mesh]] by its name or its number from 1; the first without one.
int mesh_index(const std::string& which, const std::vector<MeshDescription>& meshes) {
    if (which.empty()) return 0;
    const auto named = std::ranges::find(meshes, which, &MeshDescription::name);
    if (named != meshes.end()) return int(named - meshes.begin());
    return int(parse_number(which).value_or(1)) - 1;
}

// The keys with which the scene was loaded, beyond its file.
Result<void> add_loading_words(std::vector<TomlEdit>& edits, const Model& model,
                               const std::vector<MeshDescription>& meshes) {
    for (const SceneWord& word : model.loading_words) {
        if (is_motion_key(word.key) || word.key.starts_with("settings.") || word.key == "technique") continue;
        DERMIS_TRY_ASSIGN(const FileKey place, file_key(word));
        edits.push_back({place.table, place.key, place.value, mesh_index(place.which, meshes)});
    }
    return {};
}

// Classes that were found by name, and what was left out: a file that states them needs no guess.
void add_found_classes(std::vector<TomlEdit>& edits, const Scene& scene) {
    for (const SceneObject& object : scene.objects) {
        if (!is_guessed(object.parts)) continue;
        for (size_t i = 0; i < object.parts.size(); ++i) {
            const std::string& name = object.mesh.materials[i].name;
            if (name.empty()) continue;
            const std::string table = "material." + toml_key(name);
            edits.push_back({table, "class", toml_string(part_name(object.parts[i].part))});
            if (object.parts[i].left_out) edits.push_back({table, "visible", "false"});
        }
    }
}

// The tone, or the tint beside the file's tone or pigments.
void add_tone(std::vector<TomlEdit>& edits, const Model& model) {
    const Skin& skin = model.scene->skin;
    const Vec3 tint = model.tone > 0 ? Vec3{1, 1, 1} : saved_tint(skin);
    const std::string text = "[" + to_text(tint.x) + ", " + to_text(tint.y) + ", " + to_text(tint.z) + "]";
    edits.push_back({"skin", "albedo_tint", text == "[1, 1, 1]" ? "" : text});
    if (model.tone == 0) return;
    edits.push_back({"skin", "tone", std::to_string(model.tone)});
    for (const char* pigment : {"melanin", "blood", "oxygen", "pheomelanin", "epidermis_mm"})
        if (model.tone != skin.loaded_tone) edits.push_back({"skin", pigment, ""});
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
           (is_file ? "unit_mm = " + to_text(float(model.scene->objects.front().unit_mm)) + "\n" : "") +
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

Vec3 saved_tint(const Skin& skin) {
    const Vec3 tint = stated_tint(skin);
    const auto rounded = [](float x) { return std::round(x * 1e4f) / 1e4f; };
    return {rounded(tint.x), rounded(tint.y), rounded(tint.z)};
}

Result<std::string> scene_text(Model& model, const fs::path& directory) {
    const fs::path file = scene_file_of(model.scene_path);
    std::string text;
    bool lights_in_file = false;
    MotionDescription motion_in_file;
    std::vector<MeshDescription> meshes;
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
        meshes = scene->meshes;
        if (!lights_in_file) text += empty_lights(*model.scene);  // the studio's
    }
    std::vector<TomlEdit> edits;
    add_technique(edits, model);
    add_found_classes(edits, *model.scene);
    DERMIS_TRY(add_loading_words(edits, model, meshes));
    add_scene(edits, *model.scene, lights_in_file);
    add_tone(edits, model);
    add_motion(edits, model.scene->motion, motion_in_file);
    const std::string edited = edit_toml(text, edits);
    if (const Result<SceneDescription> read = parse_scene(edited, file, model.catalog.subjects); !read)
        return Error{"this scene file is written in a way that cannot be changed in place: " +
                     read.error().message};
    return edited;
}

}  // namespace dermis::view
