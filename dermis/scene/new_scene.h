#pragma once
// A complete, commented scene file for a mesh file.

#include <filesystem>
#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/scene/scene.h"

namespace dermis::inline scene {

struct NewScene {
    std::string toml;
    std::vector<std::string> taken;  ///< what was found or guessed, a line each
};

/// The scene of a bare mesh file (load_scene) as text for a file `output`: unit, a class for each material,
/// images beside the mesh by their names, tone and profile by the skin's colour, a camera on the face, three
/// lights, a credit to fill in. Errors: no objects, an image of the skin that cannot be read.
[[nodiscard]] Result<NewScene> new_scene(const Scene& scene, const std::filesystem::path& mesh,
                                         const std::filesystem::path& output);

}  // namespace dermis::inline scene
