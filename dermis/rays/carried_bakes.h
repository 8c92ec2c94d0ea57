#pragma once
// Bakes of a rest pose on a posed mesh of the same triangles, as tangent-space data of an engine move: what
// has a direction turns with the tangent frame (mesh/surface_frame.h); lengths
// and curvatures stay as they were at rest.

#include <span>
#include <vector>

#include "dermis/rays/diffused_normals.h"

namespace dermis::inline rays {

/// One tensor a vertex of `posed`, which has the vertices of `rest`.
[[nodiscard]] std::vector<CurvatureTensor> carried_curvatures(const Mesh& rest, const Mesh& posed);

/// Likewise, changed by stencils of the rest pose, as curvature is while a mesh moves on the device.
[[nodiscard]] std::vector<CurvatureTensor> followed_curvatures(const Mesh& rest, const Mesh& posed);

/// The map `baked` over the atlas of `rest` for `posed`, objects of the same triangles and atlas. A texel
/// whose frame has not turned keeps its bytes. Cost: 0.1 s for 1024 x 1024.
[[nodiscard]] DiffusedNormals carried_normals(std::span<const SceneObject> rest,
                                              std::span<const SceneObject> posed,
                                              const DiffusedNormals& baked);

}  // namespace dermis::inline rays
