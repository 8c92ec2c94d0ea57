#include "dermis/view/history.h"

#include <algorithm>

#include "dermis/base/text.h"
#include "dermis/scene/scene_words.h"
#include "dermis/view/head_words.h"
#include "dermis/view/scene_look.h"

namespace dermis::view {
namespace {

std::string key_of_choice(TechniqueChoice& choice) {
    std::string key = choice.technique().id + '\n';
    for (const Parameter& parameter : choice.technique().parameters.parameters)
        key += choice.values().text(parameter) + '\n';
    return key;
}

std::string key_of_look(Model& model) {
    std::string key = std::to_string(model.tone) + '\n';
    for (TechniqueChoice& choice : model.choices) key += key_of_choice(choice);
    for (const SceneWord& word : words_of(*model.scene))
        if (!word.key.starts_with("camera.")) key += word.key + '=' + word.value + '\n';
    for (const SceneWord& word : words_beside_motion(model.loading_words))
        key += word.key + '=' + word.value + '\n';
    const MotionDescription& motion = model.scene->motion;
    key += motion.clip + '\n' + to_text(motion.speed) + (motion.loop ? " loop\n" : "\n");
    for (const auto& [target, weight] : motion.morph) key += target + '=' + to_text(weight) + '\n';
    return key;
}

// Words of units decide how large the scene is, and with it where its lights are.
std::vector<SceneWord> unit_words(std::vector<SceneWord> words) {
    std::erase_if(words, [](const SceneWord& word) { return !word.key.ends_with(".unit_mm"); });
    return words;
}

}  // namespace

History::State History::state_of(Model& model, std::string key) {
    return {.key = std::move(key),
            .look = without_objects(*model.scene),
            .words = model.loading_words,
            .choices = model.choices,
            .tone = model.tone};
}

void History::follow(Model& model) {
    if (!model.scene) return;
    std::string key = key_of_look(model);
    if (!states_.empty() && states_[now_].key == key) return;
    if (!states_.empty()) states_.erase(states_.begin() + std::ptrdiff_t(now_) + 1, states_.end());
    states_.push_back(state_of(model, std::move(key)));
    if (states_.size() > kMostSteps + 1) states_.pop_front();
    now_ = states_.size() - 1;
}

void History::amend(Model& model) {
    if (model.scene && !states_.empty()) states_[now_] = state_of(model, key_of_look(model));
}

Result<bool> History::go(int step, Model& model, ShownScene& shown) {
    if (!model.scene || states_.empty() || (step < 0 ? now_ == 0 : now_ + 1 == states_.size())) return false;
    Scene& scene = *model.scene;
    const State& to = states_[now_ + size_t(step)];
    const Scene before = without_objects(scene);
    put_look(to.look, scene);
    scene.camera = before.camera;
    if (scene.motion.clip == before.motion.clip) scene.motion.time_s = before.motion.time_s;
    if (unit_words(to.words) != unit_words(model.loading_words)) scene.lights = before.lights;
    const Environment &wanted = scene.environment, &drawn = before.environment;
    if (wanted.kind != drawn.kind || wanted.file != drawn.file)
        if (const Result<void> changed = shown.stage().environment_changed(); !changed) {
            put_look(before, scene);
            return changed.error();
        }
    std::vector<SceneWord> words = words_beside_motion(to.words);
    std::ranges::copy_if(model.loading_words, std::back_inserter(words),
                         [](const SceneWord& word) { return is_motion_key(word.key); });
    model.loading_words = std::move(words);
    model.choices = to.choices;
    model.tone = to.tone;
    now_ += size_t(step);
    return true;
}

}  // namespace dermis::view
