#include "dermis/mesh/blur_vertices.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "dermis/mesh/topology.h"

namespace dermis::inline mesh {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
constexpr int kSteps = 2;
constexpr double kTolerance = 1e-5;

struct SurfaceOperators {
    Eigen::VectorXd area_mm2;
    Sparse laplacian;  // rows sum to 0
};

// Cotangent of the angle between two edges; 0 for obtuse angles and slivers.
double cotangent(Vec3 a, Vec3 b) {
    const double cosine = dot(a, b), sine = length(cross(a, b));
    return sine > 1e-12 ? std::clamp(cosine / sine, 0.0, 1e3) : 0.0;
}

SurfaceOperators operators_of(const Mesh& mesh, const Weld& weld) {
    SurfaceOperators made{Eigen::VectorXd::Zero(Eigen::Index(weld.count())), {}};
    std::vector<Eigen::Triplet<double>> entries;
    const std::vector<uint32_t> corners = welded_indices(mesh.indices, weld);
    for (size_t i = 0; i < corners.size(); i += 3)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = corners[i + k], b = corners[i + (k + 1) % 3], c = corners[i + (k + 2) % 3];
            const Vec3 at = mesh.positions_mm[weld.first[a]];
            const Vec3 to_b = mesh.positions_mm[weld.first[b]] - at,
                       to_c = mesh.positions_mm[weld.first[c]] - at;
            made.area_mm2[a] += length(cross(to_b, to_c)) / 6;
            const double weight = cotangent(to_b, to_c) / 2;
            if (weight == 0 || b == c) continue;
            entries.insert(entries.end(), {{int(b), int(c), -weight},
                                           {int(c), int(b), -weight},
                                           {int(b), int(b), weight},
                                           {int(c), int(c), weight}});
        }
    made.laplacian.resize(Eigen::Index(weld.count()), Eigen::Index(weld.count()));
    made.laplacian.setFromTriplets(entries.begin(), entries.end());
    // A vertex that no triangle uses keeps its value.
    for (double& area : made.area_mm2) area = std::max(area, 1e-9);
    return made;
}

constexpr double kLeastMassMm2 = 1e-6;  // of a vertex without samples

// The integral's matrix and right sides, one column a channel.
struct FitEquations {
    Sparse mass;
    Eigen::MatrixX3d values;
};

FitEquations equations_of(std::span<const uint32_t> corners, std::span<const SurfaceSamples> samples,
                          Eigen::Index count) {
    constexpr size_t kPairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {2, 0}, {0, 1}};
    FitEquations made{Sparse(count, count), Eigen::MatrixX3d::Zero(count, 3)};
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index i = 0; i < count; ++i) entries.emplace_back(int(i), int(i), kLeastMassMm2);
    for (size_t t = 0; t < samples.size(); ++t) {
        const uint32_t* corner = &corners[3 * t];
        for (size_t i = 0; i < 6; ++i) {
            const int a = int(corner[kPairs[i][0]]), b = int(corner[kPairs[i][1]]);
            const double product = double(samples[t].products[i]);
            entries.emplace_back(a, b, product);
            if (i >= 3) entries.emplace_back(b, a, product);
        }
        for (size_t k = 0; k < 3; ++k) {
            const Vec3 value = samples[t].values[k];
            made.values.row(Eigen::Index(corner[k])) +=
                Eigen::RowVector3d(double(value.x), double(value.y), double(value.z));
        }
    }
    made.mass.setFromTriplets(entries.begin(), entries.end());
    return made;
}

}  // namespace

void SurfaceSamples::add(const std::array<float, 3>& weights, float area_mm2, Vec3 value) {
    for (size_t k = 0; k < 3; ++k) {
        products[k] += area_mm2 * weights[k] * weights[k];
        products[3 + k] += area_mm2 * weights[(k + 1) % 3] * weights[(k + 2) % 3];
        values[k] += value * (area_mm2 * weights[k]);
    }
}

Result<std::vector<Vec3>> fit_over_surface(const Mesh& mesh, std::span<const SurfaceSamples> samples,
                                           double variance_mm2) {
    const Weld weld = weld_positions(mesh.positions_mm);
    const SurfaceOperators surface = operators_of(mesh, weld);
    const FitEquations equations =
        equations_of(welded_indices(mesh.indices, weld), samples, Eigen::Index(weld.count()));
    const Sparse system = equations.mass + surface.laplacian * (variance_mm2 / 2);
    Eigen::ConjugateGradient<Sparse, Eigen::Lower | Eigen::Upper> solver(system);
    solver.setTolerance(kTolerance);
    const Eigen::MatrixX3d u = solver.solve(equations.values);
    if (solver.info() != Eigen::Success)
        return Error{"fit over the surface: no solution; the mesh has triangles without area"};
    std::vector<Vec3> fitted;
    fitted.reserve(weld.ids.size());
    for (const uint32_t id : weld.ids) {
        const auto row = u.row(Eigen::Index(id));
        fitted.push_back({float(row[0]), float(row[1]), float(row[2])});
    }
    return fitted;
}

Result<std::vector<float>> blur_over_surface(const Mesh& mesh, std::span<const float> values,
                                             double variance_mm2) {
    const Weld weld = weld_positions(mesh.positions_mm);
    const SurfaceOperators surface = operators_of(mesh, weld);
    Eigen::VectorXd u(weld.count());
    for (size_t i = 0; i < weld.count(); ++i) u[Eigen::Index(i)] = values[weld.first[i]];
    Sparse step = surface.laplacian * (variance_mm2 / 2 / kSteps);
    step += Sparse(surface.area_mm2.asDiagonal());
    Eigen::ConjugateGradient<Sparse, Eigen::Lower | Eigen::Upper> solver(step);
    solver.setTolerance(kTolerance);
    for (int i = 0; i < kSteps; ++i) {
        const Eigen::VectorXd heat = surface.area_mm2.cwiseProduct(u);
        u = solver.solveWithGuess(heat, u);
        if (solver.info() != Eigen::Success)
            return Error{"blur over the surface: no solution; the mesh has triangles without area"};
    }
    std::vector<float> blurred;
    blurred.reserve(values.size());
    for (const uint32_t id : weld.ids) blurred.push_back(float(u[Eigen::Index(id)]));
    return blurred;
}

}  // namespace dermis::inline mesh
