#pragma once
// Catmull-Clark subdivision of a polygon cage, and displacement of what comes out.

#include <functional>

#include "dermis/base/result.h"
#include "dermis/mesh/polygons.h"

namespace dermis::inline mesh {

inline constexpr int kMaxSubdivisionLevel = 5;

/// `level` refinements, then every vertex is moved to its place on the limit surface and gets the limit's
/// normal (Catmull and Clark 1978; Halstead et al. 1993 for the limits; done by OpenSubdiv). Each level makes
/// four times the faces: a cage of 8,842 quads has 566,000 at level 3. Level 0 returns the cage as it is. UVs
/// are face-varying: smooth inside of charts, linear along their borders, so that seams stay where the maps
/// have them. Where copies of a face meet there are no normals. UV corners are joined by value, since files
/// often do not share their indices. Open borders become smooth curves with sharp corners. Errors: a level
/// outside of 0..5, more than 20 million faces, faces that use a vertex twice.
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
