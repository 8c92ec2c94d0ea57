// What a person changed, as edits of the scene file.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/scene/scene_files.h"
#include "dermis/scene/scene_paths.h"
#include "dermis/view/scene_edit.h"

namespace dermis::view {
namespace fs = std::filesystem;
namespace {

constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

// Rounded, so that 20 degrees do not come back as 19.999998.
std::string number(double value) {
    const double rounded = std::round(value * 1e4) / 1e4;
    return to_text(rounded == 0 ? 0.0 : rounded);
}
std::string degrees(float rad) {
    return number(rad * kDegreesPerRadian);
}
std::string vector(Vec3 v) {
    return "[" + number(v.x) + ", " + number(v.y) + ", " + number(v.z) + "]";
}

void add_light(std::vector<TomlEdit>& edits, const Light& light, int index) {
    const auto set = [&](const char* key, std::string value) {
        edits.push_back({"light", key, std::move(value), index});
    };
    if (light.kind == LightKind::directional) {
        const YawPitch angles = yaw_pitch_of(light.to_light_world);
        set("yaw_deg", degrees(angles.yaw_rad));
        set("pitch_deg", degrees(angles.pitch_rad));
    } else {
        for (const char* key : {"yaw_deg", "pitch_deg", "distance_mm", "target_mm"}) set(key, "");
        set("position_mm", vector(light.position_mm));
    }
    set("intensity", number(light.intensity));
    set("color", vector(light.color_linear));
}

void add_camera(std::vector<TomlEdit>& edits, const Camera& camera) {
    const Vec3 to_eye = camera.eye_mm - camera.target_mm;
    const YawPitch angles = yaw_pitch_of(to_eye);
    edits.push_back({"camera", "eye_mm", ""});
    edits.push_back({"camera", "target_mm", vector(camera.target_mm)});
    edits.push_back({"camera", "yaw_deg", degrees(angles.yaw_rad)});
    edits.push_back({"camera", "pitch_deg", degrees(angles.pitch_rad)});
    edits.push_back({"camera", "distance_mm", number(length(to_eye))});
    edits.push_back({"camera", "fov_deg", degrees(camera.vertical_fov_rad)});
}

void add_environment(std::vector<TomlEdit>& edits, const Environment& environment) {
    static constexpr const char* kKinds[] = {"none", "studio", "file"};
    const bool from_file = environment.kind == EnvironmentKind::file;
    edits.push_back({"environment", "kind", toml_string(kKinds[size_t(environment.kind)])});
    edits.push_back(
        {"environment", "file", from_file ? toml_string(fs::absolute(environment.file).string()) : ""});
    edits.push_back({"environment", "intensity", number(environment.intensity)});
    edits.push_back({"environment", "yaw_deg", degrees(environment.yaw_rad)});
    edits.push_back({"environment", "visible", environment.visible ? "true" : "false"});
}

// A choice's name is a string, a toggle true or false, three numbers an array: as [settings] has them.
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
    const ParameterValues defaults(choice.technique().parameters);
    for (const Parameter& parameter : choice.technique().parameters.parameters) {
        const bool same = choice.values().text(parameter) == defaults.text(parameter);
        edits.push_back({"settings", parameter.name, same ? "" : setting_value(parameter, choice.values())});
    }
}

// A mesh or a built-in: a scene file that has just it, with all lights of the studio.
std::string new_scene(const Model& model) {
    const std::string& path = model.scene_path;
    const bool is_file = !path.starts_with("builtin:");
    std::string text = "name = " + toml_string(model.scene->name) +
                       "\n\n[[mesh]]\nfile = " + toml_string(is_file ? fs::absolute(path).string() : path) +
                       "\n";
    for (const Light& light : model.scene->lights) {
        text += "\n[[light]]\n";
        if (!light.name.empty()) text += "name = " + toml_string(light.name) + "\n";
        if (light.is_key) text += "key = true\n";
        if (light.kind != LightKind::directional) text += "kind = \"point\"\n";
    }
    std::vector<TomlEdit> edits;
    for (size_t i = 0; i < model.scene->lights.size(); ++i) add_light(edits, model.scene->lights[i], int(i));
    return edit_toml(text, edits);
}

// Every path of the file that only means something beside it.
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

std::vector<TomlEdit> model_edits(Model& model) {
    std::vector<TomlEdit> edits;
    const Scene& scene = *model.scene;
    edits.push_back({"", "exposure_ev", number(scene.exposure_ev)});
    edits.push_back({"", "tone_map", toml_string(tone_map_names()[size_t(scene.tone_map)])});
    add_technique(edits, model);
    edits.push_back({"skin", "profile", toml_string(scene.skin.profile)});
    edits.push_back({"skin", "albedo_tint", vector(scene.skin.albedo_tint_linear)});
    const auto key = std::ranges::find(scene.lights, true, &Light::is_key);
    if (key != scene.lights.end()) add_light(edits, *key, int(key - scene.lights.begin()));
    add_environment(edits, scene.environment);
    add_camera(edits, scene.camera);
    return edits;
}

Result<std::string> scene_text(Model& model, const fs::path& directory) {
    const fs::path file = scene_file_of(model.scene_path);
    std::string text;
    if (file.empty()) {
        text = new_scene(model);
    } else {
        const Result<std::string> old = read_text_file(file);
        if (!old) return old.error();
        const Result<SceneDescription> scene = parse_scene(*old, file, model.catalog.subjects);
        if (!scene) return scene.error();
        std::error_code ec;
        const bool same_place = fs::equivalent(fs::absolute(file).parent_path(), directory, ec);
        text = same_place ? *old : with_absolute_paths(*old, *scene);
        if (scene->lights.empty()) {  // the studio's lights are nowhere in the file yet
            for (const Light& light : model.scene->lights)
                text += "\n[[light]]\n" + std::string(light.is_key ? "key = true\n" : "");
        }
    }
    const std::string edited = edit_toml(text, model_edits(model));
    if (const Result<SceneDescription> read = parse_scene(edited, file, model.catalog.subjects); !read)
        return Error{"this scene file is written in a way that cannot be changed in place: " +
                     read.error().message};
    return edited;
}

}  // namespace dermis::view
