#pragma once
// Shapes with exact normals, tangents, UVs and curvature, for scenes without files and for tests.

#include "dermis/mesh/mesh.h"

namespace dermis::inline mesh {

/// All shapes: one material, one submesh, all attributes analytic, UVs unmirrored in [0, 1] seen from
/// outside.

/// Around the origin, `segments` around and half as many from pole to pole. u runs once around from the back
/// (-Z) through -X, the front and +X; v from the top (+Y) down.
[[nodiscard]] Mesh make_sphere(float radius_mm, int segments = 64);

/// Around the Y axis: the tube of `minor_mm` has its centre line at `major_mm`. `segments` both ways.
[[nodiscard]] Mesh make_torus(float major_mm, float minor_mm, int segments = 64);

/// An open tube around the Y axis, from y = -height/2 to height/2, with about square cells.
[[nodiscard]] Mesh make_cylinder(float radius_mm, float height_mm, int segments = 64);

/// In z = 0 around the origin, facing +Z.
[[nodiscard]] Mesh make_plane(float width_mm, float height_mm, int segments = 1);

/// Around the origin with sharp edges; each face has its own sixth of the UV square.
[[nodiscard]] Mesh make_box(Vec3 size_mm);

}  // namespace dermis::inline mesh
