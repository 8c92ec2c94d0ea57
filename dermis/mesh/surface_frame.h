#pragma once
// The frame of a surface at a point, which turns as the surface does in another pose.

#include <vector>

#include "dermis/mesh/mesh.h"

namespace dermis::inline mesh {

/// A direction on the surface at each vertex that moves with it: dP/du, or an edge where the UVs have no
/// area.
[[nodiscard]] std::vector<Vec3> surface_directions(const Mesh& mesh);

/// Orthonormal: n is the unit normal, t along the direction beside it.
struct SurfaceFrame {
    Vec3 t, b, n;

    SurfaceFrame(Vec3 normal, Vec3 direction)
        : t(normalize(direction - normal * dot(normal, direction))), b(cross(normal, t)), n(normal) {}
    friend bool operator==(const SurfaceFrame&, const SurfaceFrame&) = default;
};

/// `v` with the coordinates in `to` that it has in `from`; equal frames keep its bits.
[[nodiscard]] inline Vec3 moved(const SurfaceFrame& from, const SurfaceFrame& to, Vec3 v) {
    if (from == to) return v;
    return to.t * dot(from.t, v) + to.b * dot(from.b, v) + to.n * dot(from.n, v);
}
/// R S R^T.
[[nodiscard]] CurvatureTensor moved(const SurfaceFrame& from, const SurfaceFrame& to,
                                    const CurvatureTensor& s);

}  // namespace dermis::inline mesh
