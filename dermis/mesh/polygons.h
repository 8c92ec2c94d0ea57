#pragma once
// A polygon mesh with attributes indexed per corner: the content of an OBJ file, the cage for subdivision.

#include <cstdint>
#include <span>
#include <vector>

#include "dermis/base/vec.h"
#include "dermis/mesh/material.h"
#include "dermis/mesh/mesh.h"

namespace dermis::inline mesh {

inline constexpr uint32_t kNoIndex = ~0u;

/// Same axes, winding, unit and UV origin as Mesh. Corners of a face are consecutive.
struct PolygonMesh {
    std::vector<Vec3> positions_mm;
    std::vector<Vec2> uvs;
    std::vector<Vec3> normals;

    std::vector<uint32_t> face_sizes;  ///< corners of every face, at least 3
    std::vector<uint32_t> face_materials;
    std::vector<uint32_t> corner_positions;
    std::vector<uint32_t> corner_uvs;      ///< empty, or one a corner; kNoIndex where a corner has none
    std::vector<uint32_t> corner_normals;  ///< as corner_uvs
    std::vector<Material> materials;       ///< at least one

    [[nodiscard]] size_t face_count() const { return face_sizes.size(); }
};

/// Quads are cut along the diagonal that stays inside (the shorter one when both do), larger faces by ear
/// clipping; corners equal in all attributes become one vertex. One submesh per material, in order of first
/// use. A corner without a normal gets the zero vector (compute_normals fills it), one without a UV gets (0,
/// 0).
[[nodiscard]] Mesh triangulate(const PolygonMesh& polygons);

/// Polygons of more corners are cut as a fan, because ear clipping takes cubic time.
inline constexpr uint32_t kMaxEarClipping = 512;

/// Cuts one polygon into size - 2 triangles (some may have no area) and appends their local corner numbers to
/// `triangles`. The outline runs to a hole and back along the same edge.
void triangulate_polygon(std::span<const Vec3> corners, std::vector<uint32_t>& triangles);

/// The inverse, for meshes that were read as triangles: one face per triangle, positions and UVs welded by
/// value.
[[nodiscard]] PolygonMesh polygons_of(const Mesh& mesh);

}  // namespace dermis::inline mesh
