#pragma once
// Which files a scene is made of: what to look at again when one of them changes.

#include <filesystem>
#include <vector>

#include "dermis/scene/scene_description.h"

namespace dermis::inline scene {

/// The scene file, its meshes with what they name (MTL, buffers), every map that is read from disk, the
/// panorama, the diffuse table. Sorted, each once. Baked and cached files are not among them.
[[nodiscard]] std::vector<std::filesystem::path> files_of(const Scene& scene);

/// Where a file that the description names is. Errors name the line and the key, as error_at() does.
[[nodiscard]] Result<std::filesystem::path> resolve_file(const SceneDescription& description,
                                                         const NamedFile& file);
[[nodiscard]] Error error_at(const SceneDescription& description, const NamedFile& file,
                             const std::string& message);

/// The paths of a description, in its order: every path in quotes in the file.
[[nodiscard]] std::vector<const NamedFile*> named_files(const SceneDescription& description);

/// Where these files are or would have to be; missing assets and built-ins are left out.
[[nodiscard]] std::vector<std::filesystem::path> paths_of(const SceneDescription& description);

}  // namespace dermis::inline scene
