#pragma once
// Vertex normals from triangles.

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "dermis/mesh/mesh.h"
#include "dermis/mesh/topology.h"

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

/// Corners that share a normal, around each position.
struct JoinedCorners {
    Weld weld;
    CornerTable table = {{}, 0};    ///< of the welded positions
    std::vector<uint32_t> leaders;  ///< of each corner in the table's order: the first that it is joined with
    [[nodiscard]] std::span<const uint32_t> leaders_around(uint32_t position) const {
        const auto corners = table.corners(position);
        return std::span(leaders).subspan(size_t(corners.data() - table.corners(0).data()), corners.size());
    }
};

/// Across every edge, whatever its angle.
[[nodiscard]] JoinedCorners join_corners(Weld weld, std::span<const uint32_t> indices);

/// Smooth normals of one mesh in one shape after another. It keeps what depends on the triangles and on which
/// positions coincide. Not for several threads at once.
class SmoothNormals {
  public:
    explicit SmoothNormals(std::span<const uint32_t> indices) : indices_(indices.begin(), indices.end()) {}

    /// One a vertex, that of compute_normals() at the vertex's first corner with a proper one, (0, 1, 0)
    /// without. `wanted`: a flag for each vertex, all if empty; the others get 0 unless a wanted one has
    /// their position.
    [[nodiscard]] std::vector<Vec3> of_vertices(std::span<const Vec3> positions_mm, Weld weld,
                                                std::span<const uint8_t> wanted = {});

  private:
    std::vector<uint32_t> indices_;
    std::optional<JoinedCorners> joined_;
};

/// Computes only normals that are zero or not finite; normalises the others. `smooth`, if not null, is of the
/// mesh's triangles.
void complete_normals(Mesh& mesh, SmoothNormals* smooth = nullptr);

/// The share of triangles whose vertex normals point to their back. Above a half, the file's winding is
/// reversed.
[[nodiscard]] double fraction_facing_backwards(const Mesh& mesh);

}  // namespace dermis::inline mesh
