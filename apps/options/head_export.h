#pragma once
// The head of a scene for an engine's package.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "dermis/engines/head.h"
#include "scene_choice.h"

namespace dermis::cli {

struct ExportedHead {
    Head head;
    std::string profile;                          ///< the scene's, or the one that was given
    std::vector<std::filesystem::path> inputs;    ///< files that the scene is made of
    std::map<std::string, std::string> settings;  ///< of preintegrated in the scene
};
/// Loads the scene, bakes normals and thickness (cached, with progress), and makes the files.
[[nodiscard]] Result<ExportedHead> export_head(const SceneChoice& choice, const std::string& profile,
                                               const std::string& engine);

}  // namespace dermis::cli
