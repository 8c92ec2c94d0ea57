#pragma once
// Normals of a mesh that morph targets without normals have moved. Internal to dermis/mesh.

#include <span>

#include "dermis/mesh/mesh.h"

namespace dermis::inline mesh {

/// Turns the file's normals and tangents as the computed normal of the surface turns between `before_mm` and
/// the mesh's positions, so that what a file shapes by its normals stays. Costs two compute_normals().
void turn_normals(std::span<const Vec3> before_mm, Mesh& mesh);

}  // namespace dermis::inline mesh
