#pragma once
// Isotropic triangles of a wished size on a distance field's surface.

#include "subjects/bust/surface.h"

namespace dermis::bust {

struct RemeshTarget {
    std::function<double(Point)> edge_mm;  ///< wished edge length; should vary slowly
    std::function<Point(Point)> project;   ///< onto the surface
    int rounds = 5;
};

/// Closed manifold in, closed manifold of the same topology out (only the largest connected piece is kept).
/// One thread for the edge operations, so the result does not depend on the number of cores.
[[nodiscard]] Surface remesh(const Surface& surface, const RemeshTarget& target);

/// The connected piece with the most triangles.
[[nodiscard]] Surface largest_piece(const Surface& surface);

/// Faces around every vertex, as half-edge arrays over a triangle list: half-edge h belongs to triangle h / 3
/// and runs from its corner h % 3 to the next one.
struct HalfEdges {
    explicit HalfEdges(const Surface& surface);
    std::vector<int> twin;  ///< -1 on a boundary
};

}  // namespace dermis::bust
