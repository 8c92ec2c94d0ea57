#pragma once
// A scene from whatever names one.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dermis/scene/subject.h"

namespace dermis::inline scene {

struct SceneOptions {
    std::span<const Subject> subjects = {};  ///< what "builtin:NAME" may be
    std::optional<float> mesh_unit_mm = {};  ///< of a bare mesh file; a scene file states its own
    std::vector<SceneWord> words = {};       ///< set before anything is loaded; each is_loading_key()
};

/// A scene file, a mesh file (placed in the default studio), "builtin:NAME", or the name of a file of scenes/
/// ("head_scan"). Errors name file, line and key; see docs/scene_file.md.
[[nodiscard]] Result<Scene> load_scene(const std::string& path_or_name, const SceneOptions& options);

}  // namespace dermis::inline scene
