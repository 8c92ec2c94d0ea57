// Around every position: gather a neighbourhood, write its points as heights over the tangent plane, fit
// z = a + b x + c y + d x^2/2 + e x y + f y^2/2 + (d + f) z^2/4, and take the tensor from the derivatives at
// the foot. The last term, of third order at most, makes spheres exact, which a parabola is not over more
// than a few degrees.

#include "dermis/mesh/curvature.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <optional>

#include "dermis/base/parallel.h"
#include "dermis/mesh/neighbourhood.h"

namespace dermis::inline mesh {
namespace {

using Terms = Eigen::Matrix<double, kQuadraticTerms, 1>;

// Nothing when the points do not determine the surface: a pivot of Cholesky's factor is close to 0.
std::optional<Terms> solve(const Eigen::Matrix<double, kQuadraticTerms, kQuadraticTerms>& lower,
                           const Terms& rhs) {
    const Eigen::LLT<Eigen::Matrix<double, kQuadraticTerms, kQuadraticTerms>> factor(lower);
    if (factor.info() != Eigen::Success) return std::nullopt;
    const Terms pivots = factor.matrixLLT().diagonal().array().square();
    if (!(pivots.array() > 1e-10 * lower.diagonal().array()).all()) return std::nullopt;
    return factor.solve(rhs);
}

struct Derivatives {
    double zx, zy, zxx, zxy, zyy;
};

// The tensor of the graph of z(x, y), in its own axes: S = J I^-1 II I^-1 J^T, fundamental forms I and II (do
// Carmo 1976, section 3-3) and J = (1, 0, zx; 0, 1, zy)^T; positive where it bends away from the normal.
Eigen::Matrix3d tensor_of_graph(const Derivatives& d) {
    Eigen::Matrix<double, 3, 2> j;
    j << 1, 0, 0, 1, d.zx, d.zy;
    Eigen::Matrix2d second;
    second << d.zxx, d.zxy, d.zxy, d.zyy;
    second /= -std::sqrt(1 + d.zx * d.zx + d.zy * d.zy);
    const Eigen::Matrix<double, 3, 2> dual = j * (j.transpose() * j).inverse();
    return dual * second * dual.transpose();
}

CurvatureTensor to_tensor(const Eigen::Matrix3d& s) {
    return {{float(s(0, 0)), float(s(1, 1)), float(s(2, 2))},
            {float(s(1, 2)), float(s(0, 2)), float(s(0, 1))}};
}

CurvatureTensor fit_at(const WeldedSurface& surface, uint32_t centre, const Neighbourhood& around) {
    const FitFrame frame(surface, centre, around.all, around.sigma_mm);
    const double scale = frame.scale_mm;
    if (scale == 0) return {};
    Eigen::Matrix<double, kQuadraticTerms, kQuadraticTerms> normal_matrix;
    normal_matrix.setZero();
    Terms rhs = Terms::Zero();
    for (const Neighbour& other : around.all) {
        const Vec3 p = surface.positions_mm[other.position] - frame.origin_mm;
        const double x = dot(p, frame.x_axis) / scale, y = dot(p, frame.y_axis) / scale,
                     z = dot(p, frame.n) / scale;
        const double weight = frame.weight(surface, other);
        Terms terms;
        terms << 1, x, y, (x * x + z * z / 2) / 2, x * y, (y * y + z * z / 2) / 2;
        normal_matrix.selfadjointView<Eigen::Lower>().rankUpdate(terms, weight);
        rhs += weight * z * terms;
    }
    const std::optional<Terms> solved = solve(normal_matrix, rhs);
    if (!solved) return {};
    // Implicit derivatives at the foot, where z = c[0].
    const Terms& c = *solved;
    const double s = (c[3] + c[5]) / 2, m = 1 - s * c[0];
    const double zx = c[1] / m, zy = c[2] / m;
    const Eigen::Matrix3d tensor = tensor_of_graph({zx, zy, (c[3] + s * zx * zx) / m,
                                                    (c[4] + s * zx * zy) / m, (c[5] + s * zy * zy) / m}) /
                                   scale;
    if (!tensor.allFinite()) return {};
    Eigen::Matrix3d axes;
    for (int row = 0; row < 3; ++row) {
        const auto of = [row](Vec3 v) { return double(row == 0 ? v.x : row == 1 ? v.y : v.z); };
        axes.row(row) << of(frame.x_axis), of(frame.y_axis), of(frame.n);
    }
    return to_tensor(axes * tensor * axes.transpose());
}

}  // namespace

std::vector<CurvatureTensor> compute_curvature_tensors(const Mesh& mesh, double smoothing_mm) {
    const Weld weld = weld_positions(mesh.positions_mm);
    const WeldedSurface surface(mesh, weld);
    std::vector<CurvatureTensor> welded(weld.count());
    // Large blocks: every one makes a walker, whose marks are as long as the mesh.
    parallel_for(weld.count(), 4096, [&](size_t begin, size_t end) {
        NeighbourWalker walker(surface);
        for (size_t i = begin; i < end; ++i)
            welded[i] = fit_at(surface, uint32_t(i), walker.around(uint32_t(i), smoothing_mm));
    });
    std::vector<CurvatureTensor> tensors;
    tensors.reserve(mesh.positions_mm.size());
    for (const uint32_t id : weld.ids) tensors.push_back(welded[id]);
    return tensors;
}

std::vector<float> compute_curvature(const Mesh& mesh, double smoothing_mm) {
    std::vector<float> curvatures;
    curvatures.reserve(mesh.positions_mm.size());
    for (const CurvatureTensor& tensor : compute_curvature_tensors(mesh, smoothing_mm))
        curvatures.push_back(mean_curvature(tensor));
    return curvatures;
}

}  // namespace dermis::inline mesh
