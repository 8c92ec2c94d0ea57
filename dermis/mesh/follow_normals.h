#pragma once
// Normals of a mesh that morph targets without normals have moved. Internal to dermis/mesh.

#include <span>

#include "dermis/mesh/mesh.h"
#include "dermis/mesh/normals.h"

namespace dermis::inline mesh {

/// Turns the file's normals, and its tangents if it has any, as the computed normal of the surface turns
/// between `before_mm` and the mesh's positions, so that what a file shapes by its normals stays. Costs two
/// compute_normals() of the triangles that change. `smooth` is of the mesh's triangles.
void turn_normals(std::span<const Vec3> before_mm, Mesh& mesh, SmoothNormals& smooth);
void turn_normals(std::span<const Vec3> before_mm, Mesh& mesh);

}  // namespace dermis::inline mesh
