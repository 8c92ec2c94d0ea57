#include "pose_choice.h"

#include "dermis/base/text.h"

namespace dermis::cli {

void PoseChoice::add_to(Command& command) {
    command.add_option("--clip", clip, "animation of the mesh file, listed by dermis info");
    command.add_option("--time", time_s, kTimeRange, "time in the clip in seconds; its end is held");
    command
        .add_option("--morph", morphs,
                    "TARGET=WEIGHT of a morph target, such as jawOpen=0.6; may be repeated")
        ->allow_extra_args(false);
}

Result<std::vector<SceneWord>> PoseChoice::words() const {
    std::vector<SceneWord> all;
    if (!clip.empty()) all.push_back({.key = "animation.clip", .value = clip});
    if (time_s) all.push_back({.key = "animation.time_s", .value = to_text(*time_s)});
    for (const std::string& text : morphs) {
        Result<SceneWord> word = parse_scene_word(text);
        if (!word) return Error{"--morph '" + text + "': write TARGET=WEIGHT, such as jawOpen=0.6"};
        all.push_back({.key = "morph." + word->key, .value = word->value});
    }
    return all;
}

}  // namespace dermis::cli
