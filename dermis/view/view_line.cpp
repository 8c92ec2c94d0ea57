#include "dermis/view/view_line.h"

#include <algorithm>

#include "dermis/base/text.h"
#include "dermis/render/shared_passes.h"
#include "dermis/scene/scene_description.h"
#include "dermis/scene/scene_words.h"
#include "dermis/technique/technique_list.h"
#include "dermis/view/head_words.h"
#include "dermis/view/motion.h"
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

std::string text_of(const SceneWord& word) {
    return word.key + "=" + word.value;
}

// The differences from the files: the camera and the key light in their short forms, the rest key by key.
std::string scene_options(const Scene& scene, const Scene& file) {
    constexpr std::string_view kCamera = "camera.", kLight = "light.key.";
    const std::vector<SceneWord> filed = words_of(file);
    std::string camera, light, others;
    for (const SceneWord& word : words_of(scene)) {
        if (std::ranges::find(filed, word) != filed.end()) continue;
        const std::string text = text_of(word);
        if (text.starts_with(kCamera))
            camera += (camera.empty() ? "" : " ") + text.substr(kCamera.size());
        else if (text.starts_with(kLight) && text.find(' ') == text.npos)
            light += (light.empty() ? "" : " ") + text.substr(kLight.size());
        else
            others += " --scene " + shell_word(text);
    }
    return others + (camera.empty() ? "" : " --camera " + shell_word(camera)) +
           (light.empty() ? "" : " --light " + shell_word(light));
}

// Poses in their short forms.
std::string loading_option(const SceneWord& word) {
    if (word.key == "animation.clip") return " --clip " + shell_word(word.value);
    if (word.key == "animation.time_s") return " --time " + word.value;
    if (word.key.starts_with("morph."))
        return " --morph " + shell_word(word.key.substr(6) + "=" + word.value);
    return " --scene " + shell_word(text_of(word));
}

// The word of a pose's option.
Result<SceneWord> pose_word(std::string_view option, const std::string& value) {
    if (option == "--clip") return SceneWord{"animation.clip", value};
    if (option == "--time") return SceneWord{"animation.time_s", value};
    return parse_scene_word("morph." + value);
}

// The content of a line, checked but not yet applied to the model.
struct Wanted {
    std::span<const Technique> techniques;
    TechniqueChoice choice;
    std::vector<SceneWord> words;
    std::string view;
    bool anything = false;

    Result<void> take(std::string_view option, const std::string& value) {
        anything = true;
        if (option == "-t" || option == "--technique") {
            DERMIS_TRY_ASSIGN(const Contestant chosen, parse_technique(techniques, value));
            choice.choose(*chosen.technique);
            if (!chosen.settings.empty()) choice.values() = chosen.values;
        } else if (option == "--set") {
            const Result<void> set = choice.values().set_all(std::span(&value, 1));
            return set ? set : set.error().within("--set");
        } else if (option == "--scene") {
            DERMIS_TRY_ASSIGN(SceneWord word, parse_scene_word(value));
            words.push_back(std::move(word));
        } else if (option == "--camera" || option == "--light") {
            DERMIS_TRY_ASSIGN(std::vector<SceneWord> some,
                              parse_section_words(option == "--camera" ? "camera" : "light.key", value));
            words.insert(words.end(), some.begin(), some.end());
        } else if (option == "--clip" || option == "--time" || option == "--morph") {
            DERMIS_TRY_ASSIGN(SceneWord word, pose_word(option, value));
            words.push_back(std::move(word));
        } else {
            view = value;
        }
        return {};
    }
};

}  // namespace

std::string view_line(Model& model, const Scene& file, const DrawSettings& draw) {
    TechniqueChoice& choice = model.choices[0];
    const Scene& scene = *model.scene;
    std::string line = "dermis render " + shell_word(model.scene_path) + " -t " + choice.technique().id;
    const ParameterValues& values = choice.values();
    const ParameterPreset* preset = values.preset();
    // Where the file has settings, its values would apply without a preset.
    const bool stated = file.technique == choice.technique().id && !file.settings.empty();
    if (stated || (preset && preset->name != "default"))
        line += " --set preset=" + (preset ? preset->name : "default");
    const ParameterValues defaults(choice.technique().parameters);
    for (const Parameter& parameter : choice.technique().parameters.parameters)
        if (!preset && values.get(parameter) != defaults.get(parameter))
            line += " --set " + shell_word(parameter.name + "=" + values.text(parameter));
    for (const SceneWord& word : words_to_load(model, file)) line += loading_option(word);
    // A pose that the files do not have would be framed anew.
    Scene same_pose = without_objects(file);
    if (scene.motion != file.motion) same_pose.camera = {};
    line += scene_options(scene, same_pose);
    if (model.view != "final") line += " --view " + model.view;
    if (draw.samples != 1) line += " --samples " + std::to_string(draw.samples);
    return line + " --size " + std::to_string(draw.width) + "x" + std::to_string(draw.height);
}

Result<void> apply_view_line(Model& model, std::string_view line) {
    static constexpr std::string_view kOptions[] = {"-t",      "--technique", "--set",  "--scene", "--camera",
                                                    "--light", "--view",      "--clip", "--time",  "--morph"};
    if (line.size() > kMaxLineBytes) return Error{"the clipboard holds no view: it is too long"};
    Wanted wanted{
        .techniques = model.catalog.techniques, .choice = model.choices[0], .words = {}, .view = model.view};
    // Line breaks that were added on the way, also inside of quotes, are removed.
    std::string one_line(line);
    std::ranges::replace_if(
        one_line, [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
    // Split as by a shell; with an open quote the line is not a view.
    const std::vector<std::string> words = quoted_words(one_line, "'\"").value_or(std::vector<std::string>());
    for (size_t i = 0; i + 1 < words.size(); ++i)
        if (std::ranges::find(kOptions, words[i]) != std::end(kOptions)) {
            if (const Result<void> taken = wanted.take(words[i], words[i + 1]); !taken) return taken;
            ++i;
        }
    if (!wanted.anything && line.find("yaw_deg=") != line.npos) {
        if (const Result<void> taken = wanted.take("--camera", std::string(trim(one_line))); !taken)
            return taken;
    }
    if (!wanted.anything)
        return Error{"the clipboard holds no view; copy one with ctrl+C, or write --camera 'yaw_deg=30'"};
    const std::vector<std::string> views = view_names(wanted.choice.technique());
    if (!std::ranges::count(views, wanted.view)) return Error{unknown_name("view", wanted.view, views)};
    std::vector<SceneWord> loading_words = model.loading_words;
    for (const SceneWord& word : wanted.words)
        if (is_loading_key(word.key) && !is_motion_key(word.key) &&
            std::ranges::find(loading_words, word) == loading_words.end()) {
            if (model.scene_path.starts_with("builtin:"))
                return Error{word.key + ": cannot be changed for " + model.scene_path +
                             "; save the scene (ctrl+S) and open that file"};
            DERMIS_TRY(file_key(word));
            put_word(loading_words, word);
        }
    SceneDescription posed;
    posed.motion = model.scene->motion;
    for (const SceneWord& word : wanted.words)
        if (is_motion_key(word.key)) DERMIS_TRY(set_word(posed, word, {}));
    std::erase_if(wanted.words, [](const SceneWord& word) { return is_loading_key(word.key); });
    DERMIS_TRY(check_motion(model.scene->objects, posed.motion));
    if (Result<void> set = set_words(*model.scene, wanted.words); !set) return set;
    model.scene->motion = std::move(posed.motion);
    model.loading_words = std::move(loading_words);
    model.choices[0] = std::move(wanted.choice);
    model.view = wanted.view;
    return {};
}

}  // namespace dermis::view
