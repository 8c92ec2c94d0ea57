#pragma once
// Wavefront OBJ and MTL, from memory. Internal to dermis/mesh; others call read_mesh().

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/mesh/polygons.h"
#include "dermis/mesh/read_mesh.h"

namespace dermis::inline mesh {

struct ObjFile {
    PolygonMesh polygons;  ///< in file units until scaled; V flipped already
    std::vector<std::string> warnings;
};

/// Faces of any size, negative indices, faces without UVs or normals, line continuations; smoothing groups,
/// lines, points and free-form surfaces are skipped. Returns the first error, with its line.
[[nodiscard]] Result<ObjFile> parse_obj(std::string_view text, const std::filesystem::path& name,
                                        const ReadSibling& read_sibling, const MeshOptions& options);

/// The materials of an MTL file. Map paths are made relative to the working directory through `directory`.
/// Unreadable and unused statements become warnings, once each.
[[nodiscard]] std::vector<Material> parse_mtl(std::string_view text, const std::string& name,
                                              const std::filesystem::path& directory,
                                              std::vector<std::string>& warnings);

}  // namespace dermis::inline mesh
