#pragma once
// glTF 2.0 and GLB, from memory. Internal to dermis/mesh; read_mesh is the way in.

#include <cstddef>
#include <filesystem>
#include <span>

#include "dermis/base/result.h"
#include "dermis/mesh/read_mesh.h"

namespace dermis::inline mesh::gltf {

/// The default scene in millimetres, skins posed as its nodes are. Primitives that lack normals or tangents
/// have zero vectors there if another primitive has some; UVs likewise (0, 0), colours (1, 1, 1, 1).
[[nodiscard]] Result<LoadedMesh> parse_gltf(std::span<const std::byte> bytes,
                                            const std::filesystem::path& name,
                                            const ReadSibling& read_sibling, const MeshOptions& options);

}  // namespace dermis::inline mesh::gltf
