#pragma once
// The scene of a call: its name, and the words of --scene, --camera and --light.

#include <string>
#include <tuple>
#include <vector>

#include "scene_choice.h"

namespace dermis::python {

/// Name, KEY=VALUE words, camera, light: texts as on the command line.
using SceneArguments = std::tuple<std::string, std::vector<std::string>, std::string, std::string>;

[[nodiscard]] inline cli::SceneChoice scene_choice(const SceneArguments& arguments) {
    return {.name = std::get<0>(arguments),
            .camera = std::get<2>(arguments),
            .light = std::get<3>(arguments),
            .words = std::get<1>(arguments)};
}

}  // namespace dermis::python
