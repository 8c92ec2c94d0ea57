#pragma once
// The UVs that a baked map is laid out by: the file's where each place of the skin has texels of its own,
// else the skin's atlas (scene/skin_atlas.h), which is written beside the map.

#include <filesystem>
#include <string>

#include "dermis/scene/scene.h"

namespace dermis::cli {

struct LayoutOfMap {
    UvSet uvs = UvSet::file;
    std::string reason;  ///< "the UVs of the file"; printed

    [[nodiscard]] bool is_atlas() const { return uvs == UvSet::atlas; }
};

/// `uvs` is "file", "atlas", or empty: the atlas where the scene's skin needs one. Lays out the atlas.
/// Errors: an unknown word.
[[nodiscard]] Result<LayoutOfMap> lay_out_map(Scene& scene, const std::string& uvs);

/// skin_atlas.glb for a map skin.exr.
[[nodiscard]] std::filesystem::path atlas_mesh_path(const std::filesystem::path& map);

/// The name of atlas_mesh_path() for the map's sidecar; empty where the UVs are the file's.
[[nodiscard]] std::string atlas_mesh_name(const LayoutOfMap& layout, const std::filesystem::path& map);

/// Writes atlas_mesh_path() if the layout is the atlas, and prints one line on the layout.
[[nodiscard]] Result<void> deliver_layout(const Scene& scene, const LayoutOfMap& layout,
                                          const std::filesystem::path& map);

}  // namespace dermis::cli
