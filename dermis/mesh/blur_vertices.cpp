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
    const std::vector<uint32_t> corners = welded_indices(mesh.indices, weld);
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(4 * corners.size());
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

using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;  // one a channel

// The integral's matrix and right sides.
struct FitEquations {
    Sparse mass;
    Columns values, noise;
};

FitEquations equations_of(std::span<const uint32_t> corners, std::span<const SurfaceSamples> samples,
                          Eigen::Index count) {
    constexpr size_t kPairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {2, 0}, {0, 1}};
    FitEquations made{Sparse(count, count), Columns::Zero(count, 3), Columns::Zero(count, 3)};
    const auto row = [](Vec3 v) { return Eigen::RowVector3d(double(v.x), double(v.y), double(v.z)); };
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
            made.values.row(Eigen::Index(corner[k])) += row(samples[t].values[k]);
            made.noise.row(Eigen::Index(corner[k])) += row(samples[t].noise[k]);
        }
    }
    made.mass.setFromTriplets(entries.begin(), entries.end());
    return made;
}

std::vector<Vec3> at_vertices(const Columns& welded, const Weld& weld) {
    std::vector<Vec3> values;
    values.reserve(weld.ids.size());
    for (const uint32_t id : weld.ids) {
        const auto row = welded.row(Eigen::Index(id));
        values.push_back({float(row[0]), float(row[1]), float(row[2])});
    }
    return values;
}

struct Fits {
    Columns values, noise;
};

Result<Fits> fits_of(const SurfaceOperators& surface, const FitEquations& equations, double variance_mm2) {
    const Sparse system = equations.mass + surface.laplacian * (variance_mm2 / 2);
    Eigen::ConjugateGradient<Sparse, Eigen::Lower | Eigen::Upper> solver(system);
    solver.setTolerance(kTolerance);
    Fits fits;
    fits.values = solver.solve(equations.values);
    if (solver.info() == Eigen::Success) fits.noise = solver.solve(equations.noise);
    if (solver.info() != Eigen::Success)
        return Error{"fit over the surface: no solution; the mesh has triangles without area"};
    return fits;
}

template <class Values>
Result<Values> blurred(const SurfaceOperators& surface, Values u, double variance_mm2) {
    Sparse step = surface.laplacian * (variance_mm2 / 2 / kSteps);
    step += Sparse(surface.area_mm2.asDiagonal());
    Eigen::ConjugateGradient<Sparse, Eigen::Lower | Eigen::Upper> solver(step);
    solver.setTolerance(kTolerance);
    for (int i = 0; i < kSteps; ++i) {
        const Values heat = surface.area_mm2.asDiagonal() * u;
        u = solver.solveWithGuess(heat, u);
        if (solver.info() != Eigen::Success)
            return Error{"blur over the surface: no solution; the mesh has triangles without area"};
    }
    return u;
}

constexpr int kBands = 4;
constexpr double kLeastVarianceMm2 = 1, kBandRatio = 4;  // from band to band
constexpr double kAround = 4;  // variance of the means of a band's squares, over the band's own

// Share of a band that is kept.
Result<Columns> share_above_noise(const SurfaceOperators& surface, const Fits& band, double variance_mm2) {
    const double around_mm2 = kAround * variance_mm2;
    DERMIS_TRY_ASSIGN(const Columns all, blurred(surface, Columns(band.values.cwiseAbs2()), around_mm2));
    DERMIS_TRY_ASSIGN(const Columns noise, blurred(surface, Columns(band.noise.cwiseAbs2()), around_mm2));
    return Columns((all.array() > 0).select(1 - noise.array() / all.array(), 0).cwiseMax(0).cwiseMin(1));
}

}  // namespace

void SurfaceSamples::add(const std::array<float, 3>& weights, float area_mm2, Vec3 value, bool negative) {
    for (size_t k = 0; k < 3; ++k) {
        products[k] += area_mm2 * weights[k] * weights[k];
        products[3 + k] += area_mm2 * weights[(k + 1) % 3] * weights[(k + 2) % 3];
        values[k] += value * (area_mm2 * weights[k]);
        noise[k] += value * (negative ? -area_mm2 * weights[k] : area_mm2 * weights[k]);
    }
}

Result<std::vector<Vec3>> fit_over_surface(const Mesh& mesh, std::span<const SurfaceSamples> samples,
                                           double variance_mm2) {
    const Weld weld = weld_positions(mesh.positions_mm);
    const SurfaceOperators surface = operators_of(mesh, weld);
    const FitEquations equations =
        equations_of(welded_indices(mesh.indices, weld), samples, Eigen::Index(weld.count()));
    DERMIS_TRY_ASSIGN(const Fits fits, fits_of(surface, equations, variance_mm2));
    return at_vertices(fits.values, weld);
}

Result<FitWithoutNoise> fit_without_noise(const Mesh& mesh, std::span<const SurfaceSamples> samples) {
    const Weld weld = weld_positions(mesh.positions_mm);
    const SurfaceOperators surface = operators_of(mesh, weld);
    const FitEquations equations =
        equations_of(welded_indices(mesh.indices, weld), samples, Eigen::Index(weld.count()));
    double variance_mm2 = kLeastVarianceMm2;
    DERMIS_TRY_ASSIGN(Fits fine, fits_of(surface, equations, variance_mm2));
    const auto zero = Columns::Zero(fine.values.rows(), 3);
    Fits kept = {zero, zero};
    for (int i = 0; i < kBands; ++i) {
        variance_mm2 *= kBandRatio;
        DERMIS_TRY_ASSIGN(Fits coarse, fits_of(surface, equations, variance_mm2));
        const Fits band = {fine.values - coarse.values, fine.noise - coarse.noise};
        DERMIS_TRY_ASSIGN(const Columns share, share_above_noise(surface, band, variance_mm2));
        kept.values += share.cwiseProduct(band.values);
        kept.noise += share.cwiseProduct(band.noise);
        fine = std::move(coarse);
    }
    return FitWithoutNoise{at_vertices(kept.values + fine.values, weld),
                           at_vertices(kept.noise + fine.noise, weld)};
}

Result<std::vector<std::vector<float>>> blur_over_surface(const Mesh& mesh, std::span<const float> values,
                                                          std::span<const double> variances_mm2) {
    const Weld weld = weld_positions(mesh.positions_mm);
    const SurfaceOperators surface = operators_of(mesh, weld);
    Eigen::VectorXd welded(weld.count());
    for (size_t i = 0; i < weld.count(); ++i) welded[Eigen::Index(i)] = values[weld.first[i]];
    std::vector<std::vector<float>> made;
    for (const double variance_mm2 : variances_mm2) {
        DERMIS_TRY_ASSIGN(const Eigen::VectorXd u, blurred(surface, welded, variance_mm2));
        std::vector<float>& one = made.emplace_back();
        one.reserve(values.size());
        for (const uint32_t id : weld.ids) one.push_back(float(u[Eigen::Index(id)]));
    }
    return made;
}

}  // namespace dermis::inline mesh
