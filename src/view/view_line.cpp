#include "dermis/view/view_line.h"

#include <algorithm>

#include "dermis/base/text.h"
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
    TechniqueChoice choice;
    Camera camera;
    std::vector<Light> lights;
    std::string view;
    bool anything = false;

    Result<void> take(std::string_view option, const std::string& value) {
        anything = true;
        if (option == "-t" || option == "--technique") {
            const Result<const Technique*> technique = find_technique(value);
            if (!technique) return technique.error();
            choice.choose(**technique);
        } else if (option == "--set") {
            const size_t equals = value.find('=');
            if (equals == value.npos) return Error{"--set '" + value + "': write name=value"};
            return choice.values().set(value.substr(0, equals), value.substr(equals + 1));
        } else if (option == "--camera") {
            const Result<Camera> parsed = parse_camera(value, camera);
            if (!parsed) return parsed.error();
            camera = *parsed;
        } else if (option == "--light") {
            const auto key = key_light(lights);
            if (key == lights.end()) return Error{"--light: the scene has no key light to move"};
            const Result<Light> parsed = parse_light(value, *key);
            if (!parsed) return parsed.error();
            *key = *parsed;
        } else {
            view = value;
        }
        return {};
    }
};

}  // namespace

std::string view_line(Model& model, int width, int height) {
    TechniqueChoice& choice = model.choices[0];
    std::string line = "dermis render " + shell_word(model.scene_path) + " -t " + choice.technique().id;
    const ParameterValues defaults(choice.technique().parameters);
    for (const Parameter& parameter : choice.technique().parameters.parameters) {
        const std::string text = choice.values().text(parameter);
        if (text != defaults.text(parameter)) line += " --set " + shell_word(parameter.name + "=" + text);
    }
    line += " --camera '" + camera_text(model.scene->camera) + "'";
    const auto key = key_light(model.scene->lights);
    if (key != model.scene->lights.end()) line += " --light '" + light_text(*key) + "'";
    if (model.view != "final") line += " --view " + model.view;
    return line + " --size " + std::to_string(width) + "x" + std::to_string(height);
}

Result<void> apply_view_line(Model& model, std::string_view line) {
    static constexpr std::string_view kOptions[] = {"-t",       "--technique", "--set",
                                                    "--camera", "--light",     "--view"};
    if (line.size() > kMaxLineBytes) return Error{"the clipboard holds no view: it is too long"};
    Wanted wanted{.choice = model.choices[0],
                  .camera = model.scene->camera,
                  .lights = model.scene->lights,
                  .view = model.view};
    // As a shell would split them; an open quote is no view.
    const std::vector<std::string> words = quoted_words(line, "'\"").value_or(std::vector<std::string>());
    for (size_t i = 0; i + 1 < words.size(); ++i)
        if (std::ranges::find(kOptions, words[i]) != std::end(kOptions)) {
            if (const Result<void> taken = wanted.take(words[i], words[i + 1]); !taken) return taken;
            ++i;
        }
    if (!wanted.anything && line.find("yaw=") != line.npos) {
        if (const Result<void> taken = wanted.take("--camera", std::string(trim(line))); !taken) return taken;
    }
    if (!wanted.anything)
        return Error{"the clipboard holds no view; copy one with ctrl+C, or write --camera 'yaw=30 pitch=5'"};
    const std::vector<std::string> views = view_names(wanted.choice.technique());
    if (!std::ranges::count(views, wanted.view)) return Error{unknown_name("view", wanted.view, views)};
    model.choices[0] = std::move(wanted.choice);
    model.scene->camera = wanted.camera;
    model.scene->lights = std::move(wanted.lights);
    model.view = wanted.view;
    return {};
}

}  // namespace dermis::view
