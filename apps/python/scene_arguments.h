#pragma once
// The scene of a call: its name, and the words of --scene, --camera, --light, --clip, --time and --morph.

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "calls.h"
#include "scene_choice.h"

namespace dermis::python {

/// Clip, time in s, TARGET=WEIGHT words.
using PoseArguments = std::tuple<std::string, std::optional<double>, std::vector<std::string>>;
/// Name, KEY=VALUE words, camera, light: texts as on the command line.
using SceneArguments =
    std::tuple<std::string, std::vector<std::string>, std::string, std::string, PoseArguments>;

[[nodiscard]] inline cli::PoseChoice pose_choice(const PoseArguments& arguments) {
    const auto& [clip, time_s, morphs] = arguments;
    if (time_s) check(cli::check_number("--time", *time_s, cli::kTimeRange));
    return {.clip = clip, .time_s = time_s, .morphs = morphs};
}

[[nodiscard]] inline cli::SceneChoice scene_choice(const SceneArguments& arguments) {
    return {.name = std::get<0>(arguments),
            .camera = std::get<2>(arguments),
            .light = std::get<3>(arguments),
            .words = std::get<1>(arguments),
            .pose = pose_choice(std::get<4>(arguments))};
}

}  // namespace dermis::python
