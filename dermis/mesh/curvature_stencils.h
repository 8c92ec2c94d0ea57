#pragma once
// Curvature of a mesh whose vertices move: sums over the vertices around, with weights of the shape at rest.

#include <array>
#include <span>
#include <vector>

#include "dermis/mesh/mesh.h"
#include "dermis/mesh/surface_frame.h"

namespace dermis::inline mesh {

/// The derivatives of the quadratic surface p(x, y) that is fitted to the vertices around a vertex, with the
/// weights of compute_curvature(): p_x = sum of weight (p - p_vertex), and so p_y, p_xx, p_xy, p_yy.
/// Coordinates x and y are lengths in mm in the tangent plane at rest. A fit of vectors takes stretch along
/// the surface into account. At most kMostNeighbours vertices, spread over the neighbourhood.
class CurvatureStencils {
  public:
    static constexpr size_t kMostNeighbours = 10;

    struct Entry {
        uint32_t vertex;
        std::array<float, 5> weights;  ///< x, y in 1/mm; xx, xy, yy in 1/mm^2
    };

    CurvatureStencils() = default;
    /// `mesh` is at rest. `smoothing_mm` as of compute_curvature().
    CurvatureStencils(const Mesh& mesh, double smoothing_mm);

    /// None where the vertices around determine no surface.
    [[nodiscard]] std::span<const Entry> around(uint32_t vertex) const {
        const uint32_t i = position_of_vertex_[vertex];
        return std::span(entries_).subspan(first_[i], first_[i + 1] - first_[i]);
    }
    /// The curvature of the fitted surface when the vertices of the mesh have these positions.
    [[nodiscard]] CurvatureTensor tensor(uint32_t vertex, std::span<const Vec3> positions_mm) const;

  private:
    std::vector<uint32_t> position_of_vertex_, first_;
    std::vector<Entry> entries_;
};

/// Curvature at rest that turns with the surface's frame and changes as its stencils' does, by at most
/// posing::kMostCurvatureChange. Against curvature computed in the pose: docs/figures.md#moving-heads.
struct CurvatureAtRest {
    // Of each vertex; empty for a mesh without curvature.
    std::vector<CurvatureTensor> tensors_per_mm;
    CurvatureStencils stencils;
    std::vector<CurvatureTensor> stencil_tensors_per_mm;

    CurvatureAtRest() = default;
    /// Takes Mesh::curvatures_per_mm, which has this smoothing.
    CurvatureAtRest(const Mesh& mesh, double smoothing_mm);

    /// Of a vertex whose frame `rest` is now `posed`, of a mesh with these positions.
    [[nodiscard]] CurvatureTensor posed(uint32_t vertex, const SurfaceFrame& rest, const SurfaceFrame& posed,
                                        std::span<const Vec3> positions_mm) const;
};

}  // namespace dermis::inline mesh
