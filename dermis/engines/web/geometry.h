#pragma once
// Meshes in the layout of engines/web/head.js. Internal to dermis/engines.

#include <nlohmann/json.hpp>

#include "dermis/base/result.h"
#include "dermis/engines/web/binary.h"
#include "dermis/mesh/mesh.h"

namespace dermis::inline engines::web {

/// Vertices and indices into `binary`; where they are, and the ranges of what is stored as whole numbers, as
/// JSON. `mesh` has curvature and occlusion. "parts" is the caller's: one a submesh, with "first" and
/// "count".
[[nodiscard]] Result<nlohmann::json> add_mesh(Binary& binary, const Mesh& mesh, size_t triangle_count);

/// Bytes of one vertex.
inline constexpr int kVertexBytes = 36;

}  // namespace dermis::inline engines::web
