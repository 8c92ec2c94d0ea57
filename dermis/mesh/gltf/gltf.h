#pragma once
// glTF 2.0 and GLB, from memory. Internal to dermis/mesh; read_mesh is the way in.

#include <cstddef>
#include <filesystem>
#include <span>

#include "dermis/base/result.h"
#include "dermis/mesh/read_mesh.h"

namespace dermis::gltf {

/// The default scene in millimetres. Primitives that lack normals have zero vectors there if another
/// primitive has some; UVs likewise (0, 0); tangents are kept only when every primitive has them.
[[nodiscard]] Result<LoadedMesh> parse_gltf(std::span<const std::byte> bytes,
                                            const std::filesystem::path& name,
                                            const ReadSibling& read_sibling, const MeshOptions& options);

}  // namespace dermis::gltf
