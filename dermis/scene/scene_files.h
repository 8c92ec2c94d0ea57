#pragma once
// Which files a scene is made of: what to look at again when one of them changes.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"
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

// Where scenes and assets are found.

/// Directories that "assets:NAME" is looked for in, in order: $DERMIS_ASSETS; ../shared/assets beside the
/// source tree; dermis below $XDG_DATA_HOME (~/.local/share), where tools/get_head puts its files.
[[nodiscard]] std::vector<std::filesystem::path> asset_directories();

/// "assets:NAME".
[[nodiscard]] bool is_asset(std::string_view text);

/// A path as a scene file has it: "assets:NAME", absolute, or relative to the scene file. Errors, without a
/// place: it does not exist, it is a directory; for assets, where it was looked for and how to get it.
[[nodiscard]] Result<std::filesystem::path> resolve_path(std::string_view text,
                                                         const std::filesystem::path& scene_file);

/// The source tree that the program was built from; empty when it is not on this machine.
[[nodiscard]] std::filesystem::path source_directory();

/// Directories that scenes are found in by name: ../share/dermis/scenes beside the program, where it is
/// installed; scenes/ of the source tree.
[[nodiscard]] std::vector<std::filesystem::path> scene_directories();

/// Names that load_scene() takes without a path, sorted.
[[nodiscard]] std::vector<std::string> scene_names();

/// The file of a name; empty when there is none.
[[nodiscard]] std::filesystem::path find_scene(std::string_view name);

}  // namespace dermis::inline scene
