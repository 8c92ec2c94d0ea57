#pragma once
// A similarity transform, baked into the vertices.

#include "dermis/mesh/mesh.h"

namespace dermis::inline scene {

/// p' = translation + Rz Ry Rx (scale * p): turned about X first, each rotation counter-clockwise seen from
/// its axis's tip.
struct Placement {
    float scale = 1;  ///< positive
    Vec3 rotation_rad, translation_mm;
};

/// Positions, normals and tangents move; curvatures shrink as the mesh grows.
void place_mesh(Mesh& mesh, const Placement& placement);

/// Drops the triangles of every material whose entry is true; vertices and materials stay. `hidden` has one
/// entry a material.
void hide_materials(Mesh& mesh, const std::vector<bool>& hidden);

}  // namespace dermis::inline scene
