#pragma once
// Baked normals as files for use elsewhere.

#include <array>
#include <filesystem>
#include <string>

#include "dermis/rays/diffused_normals.h"

namespace dermis::inline rays {

/// Origin of the maps, for their sidecar.
struct DiffusedNormalsOrigin {
    std::string mesh;  ///< file or scene
    std::string profile_name;
    GaussianSum profile;
    DiffusedNormalsRequest request;
    std::string uv_file = {};  ///< has the atlas's UVs; empty: the maps are over the UVs of the mesh
};

/// "skin.exr" gives skin_red.exr and skin_green.exr.
[[nodiscard]] std::array<std::filesystem::path, 2> diffused_normals_paths(const std::filesystem::path& path);

/// Whether baked normals are written with this extension.
[[nodiscard]] Result<void> check_diffused_normals_path(const std::filesystem::path& path);

/// Two maps and FILE.json beside each (the same text inside the picture under "dermis"): channel, axes,
/// encoding, profile, the weights that mix them with the shaded point's own normal. .exr holds the numbers
/// themselves in 32 bits, .png x * 0.5 + 0.5 in 16. All four files or none. Errors: another extension, a file
/// that cannot be written.
[[nodiscard]] Result<void> write_diffused_normals(const std::filesystem::path& path,
                                                  const DiffusedNormals& normals,
                                                  const DiffusedNormalsOrigin& origin);

}  // namespace dermis::inline rays
