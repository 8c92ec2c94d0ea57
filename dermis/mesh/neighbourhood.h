#pragma once
// The vertices around a vertex, along edges of the position-welded mesh. Internal to dermis/mesh.

#include <cstdint>
#include <span>
#include <vector>

#include "dermis/mesh/topology.h"

namespace dermis::inline mesh {

/// Terms of a quadratic surface over a plane: 1, x, y, and three of second order.
inline constexpr int kQuadraticTerms = 6;

struct WeldedSurface {
    std::vector<Vec3> positions_mm, normals;  ///< normals unit
    std::vector<float> areas_mm2;             ///< a third of the triangles around
    /// Along edges: neighbours[first[i] .. first[i + 1]) of position i.
    std::vector<uint32_t> first, neighbours;

    /// By Mesh::normals.
    WeldedSurface(const Mesh& mesh, const Weld& weld);
    [[nodiscard]] std::span<const uint32_t> around(uint32_t i) const {
        return std::span(neighbours).subspan(first[i], first[i + 1] - first[i]);
    }
};

struct Neighbour {
    uint32_t position;
    float distance_mm;  ///< along edges
};

/// With the vertex itself.
struct Neighbourhood {
    std::span<const Neighbour> all;
    double sigma_mm;  ///< standard deviation of their weights; 0: 0.7 of the farthest one's distance
};

/// What a fit over the tangent plane of a vertex needs.
struct FitFrame {
    Vec3 origin_mm, x_axis, y_axis, n;
    double scale_mm = 0;  ///< distance of the farthest neighbour: lengths over it give terms of like sizes
    double sigma_mm = 0;

    FitFrame(const WeldedSurface& surface, uint32_t centre, std::span<const Neighbour> neighbours,
             double sigma_mm);
    /// Of a neighbour in the least squares: a Gaussian of its distance times its area. If sigma_mm is 0, the
    /// Gaussian is that of Neighbourhood and all areas count alike; the fit then passes near the vertex.
    [[nodiscard]] double weight(const WeldedSurface& surface, const Neighbour& neighbour) const;
};

/// Walks outwards in order of distance. One per thread: its marks are reused.
class NeighbourWalker {
  public:
    explicit NeighbourWalker(const WeldedSurface& surface)
        : surface_(surface), mark_(surface.positions_mm.size(), 0) {}

    /// All within twice `smoothing_mm` along edges (1500 at most); those of two rings where these are fewer
    /// than twelve or `smoothing_mm` is 0. Valid until the next call.
    [[nodiscard]] Neighbourhood around(uint32_t centre, double smoothing_mm);

  private:
    std::span<const Neighbour> rings(uint32_t centre, int count);
    std::span<const Neighbour> within(uint32_t centre, float radius_mm);
    void start(uint32_t centre);
    [[nodiscard]] bool same_side(uint32_t centre, uint32_t at) const;
    bool visit(uint32_t centre, uint32_t at);

    const WeldedSurface& surface_;
    std::vector<uint32_t> mark_;
    uint32_t generation_ = 0;
    std::vector<Neighbour> found_;
};

}  // namespace dermis::inline mesh
