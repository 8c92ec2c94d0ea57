#pragma once
// A mesh of fewer triangles from the same vertices.

#include <cstdint>
#include <vector>

#include "dermis/mesh/mesh.h"

namespace dermis::inline mesh {

struct SimplifiedTriangles {
    std::vector<uint32_t> indices;  ///< into the mesh's vertices, of which some are not used any more
    std::vector<Submesh> submeshes;
};

/// Collapses edges to one of their ends, least change of shape first (Garland, Heckbert 1997, "Surface
/// Simplification Using Quadric Error Metrics"), until at most `triangle_count` are left. Remaining vertices
/// keep their attributes. Vertices on UV seams, borders and between submeshes stay, and no triangle turns
/// over in space or in UV; if that allows no more collapses, more triangles are left. 135,000 to 30,000 take
/// 0.5 s.
[[nodiscard]] SimplifiedTriangles simplify(const Mesh& mesh, size_t triangle_count);

}  // namespace dermis::inline mesh
