#pragma once
// Vertex normals from triangles.

#include "dermis/mesh/mesh.h"

namespace dermis::inline mesh {

struct NormalOptions {
    /// Edges between faces that differ by more stay sharp; their vertices are split. 180: smooth everywhere.
    float crease_angle_deg = 180;
};

/// Angle-weighted (Thuermer and Wuethrich 1998, "Computing Vertex Normals from Polygonal Facets"), summed
/// over all faces around a position that are connected by edges, whether or not a UV seam runs between them.
/// Surfaces that touch in a point only stay separate. Where a sum cancels (opposite sides of a fold) each
/// face keeps its own normal. Every normal is unit and finite; a vertex without a proper face gets (0, 1, 0).
/// Drops tangents and curvatures, which depend on the normals. Linear time, about 4 ms per 10,000 vertices.
void compute_normals(Mesh& mesh, const NormalOptions& options = {});

/// Computes only normals that are zero or not finite; normalises the others.
void complete_normals(Mesh& mesh);

/// The share of triangles whose vertex normals point to their back. Above a half, the file's winding is
/// reversed.
[[nodiscard]] double fraction_facing_backwards(const Mesh& mesh);

}  // namespace dermis::inline mesh
