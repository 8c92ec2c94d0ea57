#pragma once
// Catmull-Clark subdivision of a polygon cage, and displacement of the result.

#include <functional>

#include "dermis/base/result.h"
#include "dermis/mesh/polygons.h"

namespace dermis::inline mesh {

inline constexpr int kMaxSubdivisionLevel = 5;

/// `level` refinements; then every vertex moves to the limit surface and gets its normal (Catmull and Clark
/// 1978; Halstead et al. 1993 for the limits; by OpenSubdiv). Each level has four times the faces. Level 0
/// returns the cage. UVs are face-varying: smooth inside charts, linear along borders, so seams stay in
/// place; UV corners are joined by value. Duplicate faces have no normals where they meet. Open borders
/// become smooth curves with sharp corners. Errors: a level outside 0..5, more than 20 million faces, faces
/// that use a vertex twice.
[[nodiscard]] Result<PolygonMesh> subdivide(const PolygonMesh& cage, int level);

struct DisplacementOptions {
    float mid = 0.5f;        ///< the height that leaves the surface where it is
    float amplitude_mm = 1;  ///< how far a height of mid + 1 lifts it, along the normal
};

/// Moves every vertex along its normal by (height(uv) - mid) * amplitude_mm and recomputes normals and
/// tangents; curvatures are dropped. Across UV seams the heights of both sides are averaged, so no crack
/// opens. `height` must be safe to call from several threads. Needs UVs and normals.
void displace(Mesh& mesh, const std::function<float(Vec2 uv)>& height, const DisplacementOptions& options);

}  // namespace dermis::inline mesh
