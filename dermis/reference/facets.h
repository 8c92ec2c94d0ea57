#pragma once
// Facets of a coarse mesh. Shading normals hide them from techniques; a walk moves in the polyhedron, and
// light with a path shorter than an edge leaves near convex edges as if all curvature of the skin were there.

#include <string>

#include "dermis/scene/scene.h"

namespace dermis::inline reference {

/// Angle between the normals of the vertices and the plane of their triangle, rms over the area of all skin,
/// in degrees; 0 without skin. It halves with each level of subdivision.
[[nodiscard]] double facet_angle_deg(const Scene& scene);

/// Empty where facets are small enough for walks: 5 degrees. Above, shares of techniques in green and blue
/// fall (docs/figures.md, facets).
[[nodiscard]] std::string facets_note(const Scene& scene);

}  // namespace dermis::inline reference
