#pragma once
// Baked maps as files: EXR half with what its numbers mean inside and beside it, and a picture to look at;
// thickness as 8-bit PNG too, which engines read.

#include <filesystem>
#include <optional>
#include <string>

#include "dermis/base/result.h"
#include "dermis/image/image.h"
#include "dermis/rays/bake_map.h"

namespace dermis::inline rays {

/// Origin of a map, for its sidecar.
struct MapOrigin {
    std::string mesh;  ///< file or scene
    BakeMapSettings settings;
    std::string uv_file = {};  ///< has the atlas's UVs; empty: the map is over the UVs of the mesh
};

/// FILE.exr (half), FILE.exr.json (kind, unit, channels, size, v_origin, encoding, range of the covered
/// texels, gutter, settings, tool; the same text inside the EXR under "dermis"), and FILE_preview.png. Each
/// is written whole or not at all. Thickness also as FILE.png: 8 bit, linear, grey, 1 is the settings'
/// max_mm. Errors: an extension other than .exr, a file that cannot be written.
[[nodiscard]] Result<void> write_map(const std::filesystem::path& path, const BakedMap& map,
                                     const MapOrigin& origin);

/// u8 sRGB: curvature blue (concave) over white to red (convex), gain its colour times 0.5, others grey from
/// black at 0; the 98th percentile is full. Background is dark grey.
[[nodiscard]] Image map_preview(const BakedMap& map);

/// Whether a map of these settings can be written with this extension, before it is baked.
[[nodiscard]] Result<void> check_map_path(const std::filesystem::path& path, const BakeMapSettings& settings);

/// What a map that write_map() made holds, by its sidecar: a line, or nothing for another file. Errors: the
/// picture is not that of its sidecar, or cannot be read.
[[nodiscard]] Result<std::optional<std::string>> describe_map(const std::filesystem::path& path);

[[nodiscard]] std::filesystem::path map_sidecar_path(const std::filesystem::path& path);
[[nodiscard]] std::filesystem::path map_preview_path(const std::filesystem::path& path);

}  // namespace dermis::inline rays
