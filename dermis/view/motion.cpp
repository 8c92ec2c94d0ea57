#include "dermis/view/motion.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/text.h"
#include "dermis/scene/scene_words.h"

namespace dermis::view {
namespace {

constexpr double kRestS = 0.35;  // without a change, before a pose is loaded

// What differs from no motion, or from what the files say.
std::vector<SceneWord> motion_words(const MotionDescription& motion, const MotionDescription& file) {
    const MotionDescription none;
    std::vector<SceneWord> words;
    const auto add = [&](auto member, const char* key, const std::string& value) {
        if (motion.*member != none.*member || file.*member != none.*member)
            words.push_back({std::string("animation.") + key, value});
    };
    add(&MotionDescription::clip, "clip", motion.clip);
    add(&MotionDescription::time_s, "time_s", to_text(motion.time_s));
    add(&MotionDescription::speed, "speed", to_text(motion.speed));
    add(&MotionDescription::loop, "loop", motion.loop ? "true" : "false");
    std::map<std::string, float> weights = motion.morph;
    for (const auto& [target, weight] : file.morph) weights.try_emplace(target, 0.0f);
    for (const auto& [target, weight] : weights) words.push_back({"morph." + target, to_text(weight)});
    return words;
}

}  // namespace

bool has_motion(const Scene& scene) {
    return std::ranges::any_of(scene.objects, [](const SceneObject& object) {
        return !object.motion.clips.empty() || !object.motion.targets.empty();
    });
}

std::vector<ClipInfo> clips_of(const Scene& scene) {
    std::vector<ClipInfo> clips;
    for (const SceneObject& object : scene.objects)
        for (const ClipInfo& clip : object.motion.clips)
            if (std::ranges::find(clips, clip.name, &ClipInfo::name) == clips.end()) clips.push_back(clip);
    return clips;
}

std::vector<std::string> targets_of(const Scene& scene) {
    std::vector<std::string> targets;
    for (const SceneObject& object : scene.objects)
        for (const std::string& target : object.motion.targets)
            if (std::ranges::find(targets, target) == targets.end()) targets.push_back(target);
    return targets;
}

Result<void> set_motion(Scene& scene, MotionDescription motion) {
    DERMIS_TRY(check_motion(scene.objects, motion));
    scene.motion = std::move(motion);
    return {};
}

Result<void> play(Model& model) {
    const std::vector<ClipInfo> clips = model.scene ? clips_of(*model.scene) : std::vector<ClipInfo>();
    if (clips.empty()) return Error{"this scene has no clip to play"};
    MotionDescription& motion = model.scene->motion;
    if (motion.clip.empty()) motion.clip = clips.front().name;
    if (motion.time_s >= clip_length_s(*model.scene)) motion.time_s = 0;
    model.playing = true;
    return {};
}

void advance_motion(Model& model, double elapsed_s) {
    if (!model.playing || !model.scene) return;
    MotionDescription& motion = model.scene->motion;
    const double length_s = clip_length_s(*model.scene);
    motion.time_s += elapsed_s;
    if (motion.time_s < length_s) return;
    model.playing = motion.loop && length_s > 0;
    motion.time_s = model.playing ? std::fmod(motion.time_s, length_s) : length_s;
}

std::vector<SceneWord> words_to_load(const Model& model, const Scene& file) {
    std::vector<SceneWord> words = model.loading_words;
    const MotionDescription& motion = model.scene->motion;
    if (motion == file.motion) return words;
    std::erase_if(words, [](const SceneWord& word) { return is_motion_key(word.key); });
    for (SceneWord& word : motion_words(motion, file.motion)) words.push_back(std::move(word));
    return words;
}

std::string motion_text(const Model& model) {
    const MotionDescription& motion = model.scene->motion;
    std::string text = "clip " + motion.clip + "\ntime_s " + to_text(motion.time_s) + "\nplaying " +
                       (model.playing ? "yes" : "no") + "\n";
    for (const auto& [target, weight] : motion.morph)
        text += "morph " + target + "=" + to_text(weight) + "\n";
    return text;
}

bool RestingPose::is_to_be_loaded(const Model& model, const ShownScene& shown, double now_s) {
    if (!model.scene) return false;
    const Pose pose = model.scene->motion.pose();
    if (pose != seen_) seen_ = pose, changed_s_ = now_s;
    if (shown.is_loaded_in_its_pose()) asked_.reset();
    return !model.playing && now_s - changed_s_ >= kRestS && is_due(shown);
}

}  // namespace dermis::view
