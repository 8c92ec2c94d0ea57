#pragma once
// A polygon mesh whose attributes are indexed per corner: what an OBJ file says, and the cage that
// subdivision needs. Triangulating it gives the Mesh of everything else.

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
/// clipping; corners equal in all attributes become one vertex. One submesh a material, in order of first
/// use. A corner without a normal gets the zero vector (compute_normals fills it), one without a UV gets (0,
/// 0).
[[nodiscard]] Mesh triangulate(const PolygonMesh& polygons);

/// Polygons of more corners are cut as a fan: ear clipping takes the cube of their number.
inline constexpr uint32_t kMaxEarClipping = 512;

/// Cuts one polygon into triangles of local corner numbers, three a triangle, size - 2 triangles always (some
/// without area), appended to `triangles`. A hole is given as files do: the outline runs to it and back along
/// the same edge.
void triangulate_polygon(std::span<const Vec3> corners, std::vector<uint32_t>& triangles);

/// The way back, for meshes that were read as triangles: every triangle a face, positions and UVs welded by
/// value.
[[nodiscard]] PolygonMesh polygons_of(const Mesh& mesh);

}  // namespace dermis::inline mesh
