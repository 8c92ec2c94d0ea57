#pragma once
// Displacement maps: heights that move the vertices of a mesh.

#include "dermis/base/result.h"
#include "dermis/mesh/mesh.h"

namespace dermis::inline scene {

/// Reads the displacement map of the mesh's material (red channel, bilinear) and moves every vertex along its
/// normal by (height - displacement_mid) * displacement_amplitude_mm; normals and tangents are computed
/// again. Nothing happens when no material has one. Errors: the file; a mesh of several materials, whose maps
/// would tear it; no UVs.
[[nodiscard]] Result<void> apply_displacement(Mesh& mesh);

}  // namespace dermis::inline scene
