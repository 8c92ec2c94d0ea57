#include "dermis/mesh/curvature_stencils.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "dermis/base/parallel.h"
#include "dermis/mesh/neighbourhood.h"
#include "shaders/include/posing.h"

namespace dermis::inline mesh {
namespace {

using StencilEntries = std::vector<CurvatureStencils::Entry>;

// In the order of the walk, which is that of their distance.
std::vector<Neighbour> thinned(std::span<const Neighbour> all) {
    const size_t count = std::min(all.size(), CurvatureStencils::kMostNeighbours + 1);
    std::vector<Neighbour> kept;
    for (size_t i = 0; i < count; ++i) kept.push_back(all[i * all.size() / count]);
    return kept;
}

// Rows of (A^T W A)^-1 A^T W: A has the terms 1, x, y, x^2/2, xy, y^2/2 of each neighbour.
StencilEntries stencil_at(const WeldedSurface& surface, uint32_t centre, const Neighbourhood& around) {
    const std::vector<Neighbour> neighbours = thinned(around.all);
    const FitFrame frame(surface, centre, neighbours, around.sigma_mm);
    const double scale = frame.scale_mm;
    if (scale == 0) return {};
    const auto count = Eigen::Index(neighbours.size());
    Eigen::Matrix<double, Eigen::Dynamic, kQuadraticTerms> terms(count, kQuadraticTerms);
    Eigen::VectorXd weights(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Neighbour& other = neighbours[size_t(i)];
        const Vec3 p = surface.positions_mm[other.position] - frame.origin_mm;
        const double x = dot(p, frame.x_axis) / scale, y = dot(p, frame.y_axis) / scale;
        terms.row(i) << 1, x, y, x * x / 2, x * y, y * y / 2;
        weights[i] = frame.weight(surface, other);
    }
    const Eigen::Matrix<double, kQuadraticTerms, Eigen::Dynamic> weighted =
        terms.transpose() * weights.asDiagonal();
    const Eigen::LDLT<Eigen::Matrix<double, kQuadraticTerms, kQuadraticTerms>> factor(weighted * terms);
    const auto pivots = factor.vectorD().array();
    if (factor.info() != Eigen::Success || !(pivots > 1e-8 * pivots.maxCoeff()).all()) return {};
    const Eigen::Matrix<double, kQuadraticTerms, Eigen::Dynamic> rows = factor.solve(weighted);
    if (!rows.allFinite()) return {};
    StencilEntries entries;
    for (Eigen::Index i = 0; i < count; ++i) {
        if (neighbours[size_t(i)].position == centre) continue;
        CurvatureStencils::Entry entry{neighbours[size_t(i)].position, {}};
        for (Eigen::Index k = 1; k < kQuadraticTerms; ++k)
            entry.weights[size_t(k - 1)] = float(rows(k, i) / (k < 3 ? scale : scale * scale));
        entries.push_back(entry);
    }
    return entries;
}

}  // namespace

CurvatureStencils::CurvatureStencils(const Mesh& mesh, double smoothing_mm) {
    const Weld weld = weld_positions(mesh.positions_mm);
    const WeldedSurface surface(mesh, weld);
    std::vector<StencilEntries> of_positions(weld.count());
    parallel_for(weld.count(), 4096, [&](size_t begin, size_t end) {
        NeighbourWalker walker(surface);
        for (size_t i = begin; i < end; ++i)
            of_positions[i] = stencil_at(surface, uint32_t(i), walker.around(uint32_t(i), smoothing_mm));
    });
    for (const StencilEntries& entries : of_positions) {
        first_.push_back(uint32_t(entries_.size()));
        for (Entry entry : entries) {
            entry.vertex = weld.first[entry.vertex];
            entries_.push_back(entry);
        }
    }
    first_.push_back(uint32_t(entries_.size()));
    position_of_vertex_ = weld.ids;
}

CurvatureTensor CurvatureStencils::tensor(uint32_t vertex, std::span<const Vec3> positions_mm) const {
    posing::SurfaceDerivatives sum{};
    for (const Entry& entry : around(vertex)) {
        const Vec3 step = positions_mm[entry.vertex] - positions_mm[vertex];
        sum.x += step * entry.weights[0];
        sum.y += step * entry.weights[1];
        sum.xx += step * entry.weights[2];
        sum.xy += step * entry.weights[3];
        sum.yy += step * entry.weights[4];
    }
    const posing::CurvatureForm form = posing::curvature_form(sum);
    const Vec3 x = posing::curvature_along(form, {1, 0, 0}), y = posing::curvature_along(form, {0, 1, 0}),
               z = posing::curvature_along(form, {0, 0, 1});
    return {{x.x, y.y, z.z}, {y.z, x.z, x.y}};
}

CurvatureAtRest::CurvatureAtRest(const Mesh& mesh, double smoothing_mm)
    : tensors_per_mm(mesh.curvatures_per_mm) {
    if (tensors_per_mm.empty()) return;
    stencils = CurvatureStencils(mesh, smoothing_mm);
    for (uint32_t v = 0; v < tensors_per_mm.size(); ++v)
        stencil_tensors_per_mm.push_back(stencils.tensor(v, mesh.positions_mm));
}

CurvatureTensor CurvatureAtRest::posed(uint32_t vertex, const SurfaceFrame& rest, const SurfaceFrame& posed,
                                       std::span<const Vec3> positions_mm) const {
    const CurvatureTensor turned = moved(rest, posed, tensors_per_mm[vertex]),
                          before = moved(rest, posed, stencil_tensors_per_mm[vertex]),
                          after = stencils.tensor(vertex, positions_mm);
    const Vec3 diagonal = after.diagonal - before.diagonal, mixed = after.mixed - before.mixed;
    const float limit = posing::change_limit(diagonal, mixed);
    return {turned.diagonal + diagonal * limit, turned.mixed + mixed * limit};
}

}  // namespace dermis::inline mesh
