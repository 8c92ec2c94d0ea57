#pragma once
// A placement, baked into the vertices.

#include "dermis/base/result.h"
#include "dermis/scene/scene.h"

namespace dermis::inline scene {

/// Positions, normals and tangents move; curvatures shrink as the mesh grows.
void place_mesh(Mesh& mesh, const Placement& placement);

/// Drops the triangles of every material whose entry is true; vertices and materials stay. `hidden` has one
/// entry a material.
void hide_materials(Mesh& mesh, const std::vector<bool>& hidden);

// Displacement maps: heights that move the vertices of a mesh.

/// Reads the displacement map of the mesh's material (red channel, bilinear) and moves every vertex along its
/// normal by (height - displacement_mid) * displacement_amplitude_mm; normals and tangents are computed
/// again. Nothing happens when no material has one. Errors: the file; a mesh of several materials, whose maps
/// would tear it; no UVs.
[[nodiscard]] Result<void> apply_displacement(Mesh& mesh);

}  // namespace dermis::inline scene
