// Curvature and thickness measured on the triangles, compared with those of the field.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bust/standard_bust.h"

namespace dermis {
namespace {

using bust::Point;

Point to_point(Vec3 v) {
    return {v.x, v.y, v.z};
}

struct VertexCurvature {
    double mean_per_mm = 0, area_mm2 = 0, edge_mm = 0;
};

/// Cotangent Laplacian over the welded mesh (Meyer, Desbrun, Schroeder & Barr 2003, equation 8, barycentric
/// areas).
std::vector<VertexCurvature> mesh_curvature(const Mesh& mesh) {
    const std::vector<uint32_t> id = welded(mesh);
    std::vector<Point> laplacian(mesh.positions_mm.size());
    std::vector<VertexCurvature> out(laplacian.size());
    std::vector<int> degree(laplacian.size(), 0);
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        for (int k = 0; k < 3; ++k) {
            const uint32_t a = id[mesh.indices[i + k]], b = id[mesh.indices[i + (k + 1) % 3]],
                           c = id[mesh.indices[i + (k + 2) % 3]];
            const Point p = to_point(mesh.positions_mm[a]), q = to_point(mesh.positions_mm[b]),
                        r = to_point(mesh.positions_mm[c]);
            const double doubled_area = length(cross(q - p, r - p));
            const double cotangent = dot(p - r, q - r) / std::max(doubled_area, 1e-12);
            laplacian[a] = laplacian[a] + (q - p) * cotangent;
            laplacian[b] = laplacian[b] + (p - q) * cotangent;
            out[a].area_mm2 += doubled_area / 6;
            out[a].edge_mm += length(q - p);
            ++degree[a];
        }
    for (size_t i = 0; i < out.size(); ++i) {
        if (degree[i] == 0) continue;
        out[i].edge_mm /= degree[i];
        out[i].mean_per_mm = -0.25 * dot(laplacian[i], to_point(mesh.normals[i])) / out[i].area_mm2;
    }
    return out;
}

TEST(BustAgreement, CurvatureOfTheTrianglesIsTheFields) {
    const Mesh& mesh = standard_bust().mesh;
    const std::vector<VertexCurvature> found = mesh_curvature(mesh);
    std::vector<double> error;
    double sum_product = 0, sum_mesh = 0, sum_field = 0;
    for (size_t i = 0; i < found.size(); i += 11) {
        if (found[i].edge_mm == 0) continue;
        const double wanted =
            standard_field().mean_curvature_per_mm(to_point(mesh.positions_mm[i]), 0.5 * found[i].edge_mm);
        if (std::abs(wanted) > 0.5 / found[i].edge_mm) continue;  // bends within one triangle
        error.push_back(std::abs(found[i].mean_per_mm - wanted));
        sum_product += found[i].mean_per_mm * wanted;
        sum_mesh += found[i].mean_per_mm * found[i].mean_per_mm;
        sum_field += wanted * wanted;
    }
    ASSERT_GT(error.size(), 4000u);
    std::sort(error.begin(), error.end());
    EXPECT_LT(error[error.size() / 2], 0.001);
    EXPECT_LT(error[error.size() * 9 / 10], 0.02);
    EXPECT_GT(sum_product / std::sqrt(sum_mesh * sum_field), 0.95);
}

/// Nearest triangle along a ray beyond 0.05 mm (Moeller & Trumbore 1997).
double ray_length_mm(const Mesh& mesh, Point from, Point direction) {
    double nearest = 1e9;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const Point a = to_point(mesh.positions_mm[mesh.indices[i]]);
        const Point e = to_point(mesh.positions_mm[mesh.indices[i + 1]]) - a,
                    f = to_point(mesh.positions_mm[mesh.indices[i + 2]]) - a;
        const Point h = cross(direction, f);
        const double det = dot(e, h);
        if (std::abs(det) < 1e-14) continue;
        const Point s = from - a, q = cross(s, e);
        const double u = dot(s, h) / det, v = dot(direction, q) / det, t = dot(f, q) / det;
        if (u >= 0 && v >= 0 && u + v <= 1 && t > 0.05) nearest = std::min(nearest, t);
    }
    return nearest;
}

TEST(BustAgreement, ThicknessThroughTheTrianglesIsTheFields) {
    const Mesh& mesh = standard_bust().mesh;
    constexpr double kMost = 40;
    std::vector<double> error;
    int thin = 0;
    for (size_t i = 0; i < mesh.positions_mm.size(); i += 239) {
        const Point p = to_point(mesh.positions_mm[i]), n = standard_field().normal(p);
        const double wanted = standard_field().thickness_mm(p, kMost);
        const double found = std::min(kMost, ray_length_mm(mesh, p - n * 0.02, n * -1) + 0.02);
        thin += wanted < 10;
        error.push_back(std::abs(found - wanted));
    }
    EXPECT_GT(thin, 15);
    std::sort(error.begin(), error.end());
    EXPECT_LT(error[error.size() / 2], 0.05);
    EXPECT_LT(error[error.size() * 9 / 10], 0.5);
}

}  // namespace
}  // namespace dermis
