#include "dermis/view/view_line.h"

#include <algorithm>
#include <filesystem>

#include "dermis/base/text.h"
#include "dermis/optics/presets.h"
#include "dermis/render/shared_passes.h"
#include "dermis/view/words.h"

namespace dermis::view {
namespace {

constexpr size_t kMaxLineBytes = 1 << 16;

bool needs_quotes(std::string_view word) {
    return word.empty() || word.find_first_not_of(
                               "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                               "_./:=,+-") != word.npos;
}

// For a POSIX shell.
std::string shell_word(std::string_view word) {
    if (!needs_quotes(word)) return std::string(word);
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

std::vector<Light>::iterator key_light(std::vector<Light>& lights) {
    return std::ranges::find(lights, true, &Light::is_key);
}

// What a line asks for, checked and not yet in the model.
struct Wanted {
    std::span<const Technique> techniques;
    TechniqueChoice choice;
    Scene scene;  ///< without objects
    std::string view;
    bool anything = false;

    Result<void> take(std::string_view option, const std::string& value) {
        anything = true;
        if (option == "-t" || option == "--technique") {
            const Result<const Technique*> technique = find_technique(techniques, value);
            if (!technique) return technique.error();
            choice.choose(**technique);
        } else if (option == "--set") {
            const size_t equals = value.find('=');
            if (equals == value.npos) return Error{"--set '" + value + "': write name=value"};
            return choice.values().set(value.substr(0, equals), value.substr(equals + 1));
        } else if (option == "--camera") {
            const Result<Camera> parsed = parse_camera(value, scene.camera);
            if (!parsed) return parsed.error();
            scene.camera = *parsed;
        } else if (option == "--light") {
            const auto key = key_light(scene.lights);
            if (key == scene.lights.end()) return Error{"--light: the scene has no key light to move"};
            const Result<Light> parsed = parse_light(value, *key, scene.bounds_center_mm);
            if (!parsed) return parsed.error();
            *key = *parsed;
        } else if (option == "--look") {
            if (Result<void> parsed = parse_look(value, scene); !parsed) return parsed;
            if (const auto known = find_profile(scene.skin.profile); !known) return known.error();
        } else if (option == "--environment") {
            scene.environment.kind = EnvironmentKind::file;
            scene.environment.file = value;
        } else {
            view = value;
        }
        return {};
    }
};

// A scene has its objects in it, which are large; this has what texts speak of.
Scene without_objects(const Scene& scene) {
    return {.lights = scene.lights,
            .camera = scene.camera,
            .environment = scene.environment,
            .skin = scene.skin,
            .tone_map = scene.tone_map,
            .exposure_ev = scene.exposure_ev,
            .bounds_center_mm = scene.bounds_center_mm};
}

}  // namespace

std::string view_line(Model& model, const SceneLook& file, const DrawSettings& draw) {
    TechniqueChoice& choice = model.choices[0];
    const Scene& scene = *model.scene;
    std::string line = "dermis render " + shell_word(model.scene_path) + " -t " + choice.technique().id;
    const ParameterValues defaults(choice.technique().parameters);
    for (const Parameter& parameter : choice.technique().parameters.parameters) {
        const std::string text = choice.values().text(parameter);
        // A scene's own settings count where its own technique is named.
        const bool stated = file.technique == choice.technique().id && file.settings.contains(parameter.name);
        if (stated || text != defaults.text(parameter))
            line += " --set " + shell_word(parameter.name + "=" + text);
    }
    line += " --camera '" + camera_text(scene.camera) + "'";
    const auto key = std::ranges::find(scene.lights, true, &Light::is_key);
    if (key != scene.lights.end()) line += " --light '" + light_text(*key, scene.bounds_center_mm) + "'";
    Scene as_filed = without_objects(scene);
    put_look(file, as_filed);
    if (const std::string look = look_text(scene, as_filed); !look.empty())
        line += " --look " + shell_word(look);
    if (scene.environment.kind == EnvironmentKind::file && scene.environment.file != file.environment.file)
        line += " --environment " +
                shell_word(std::filesystem::absolute(scene.environment.file).lexically_normal().string());
    if (model.view != "final") line += " --view " + model.view;
    if (draw.samples != 1) line += " --samples " + std::to_string(draw.samples);
    return line + " --size " + std::to_string(draw.width) + "x" + std::to_string(draw.height);
}

Result<void> apply_view_line(Model& model, std::string_view line) {
    static constexpr std::string_view kOptions[] = {"-t",      "--technique", "--set",         "--camera",
                                                    "--light", "--look",      "--environment", "--view"};
    if (line.size() > kMaxLineBytes) return Error{"the clipboard holds no view: it is too long"};
    Wanted wanted{.techniques = model.catalog.techniques,
                  .choice = model.choices[0],
                  .scene = without_objects(*model.scene),
                  .view = model.view};
    // A line that was broken on its way, inside of quotes too, is one line.
    std::string one_line(line);
    std::ranges::replace_if(
        one_line, [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
    // As a shell would split them; an open quote is no view.
    const std::vector<std::string> words = quoted_words(one_line, "'\"").value_or(std::vector<std::string>());
    for (size_t i = 0; i + 1 < words.size(); ++i)
        if (std::ranges::find(kOptions, words[i]) != std::end(kOptions)) {
            if (const Result<void> taken = wanted.take(words[i], words[i + 1]); !taken) return taken;
            ++i;
        }
    if (!wanted.anything && line.find("yaw=") != line.npos) {
        if (const Result<void> taken = wanted.take("--camera", std::string(trim(one_line))); !taken)
            return taken;
    }
    if (!wanted.anything)
        return Error{"the clipboard holds no view; copy one with ctrl+C, or write --camera 'yaw=30 pitch=5'"};
    const std::vector<std::string> views = view_names(wanted.choice.technique());
    if (!std::ranges::count(views, wanted.view)) return Error{unknown_name("view", wanted.view, views)};
    model.choices[0] = std::move(wanted.choice);
    put_look(look_of(wanted.scene), *model.scene);
    model.view = wanted.view;
    return {};
}

}  // namespace dermis::view
