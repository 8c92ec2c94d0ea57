#include "dermis/mesh/stretch.h"

#include <algorithm>
#include <cmath>

#include "dermis/mesh/topology.h"

namespace dermis::inline mesh {
namespace {

// P is linear over a triangle: [d1 d2] = [P_u P_v] [uv1 uv2], solved for P_u and P_v.
UvMetric metric_of(const Mesh& mesh, size_t first) {
    const auto p = [&](size_t k) { return mesh.positions_mm[mesh.indices[first + k]]; };
    const auto uv = [&](size_t k) { return mesh.uvs[mesh.indices[first + k]]; };
    const double u1 = double(uv(1).x) - uv(0).x, v1 = double(uv(1).y) - uv(0).y;
    const double u2 = double(uv(2).x) - uv(0).x, v2 = double(uv(2).y) - uv(0).y;
    const double det = u1 * v2 - u2 * v1;
    if (det == 0) return {};
    const Vec3 d1 = p(1) - p(0), d2 = p(2) - p(0);
    const double a = dot(d1, d1), b = dot(d1, d2), c = dot(d2, d2);
    const double s = 1 / (det * det);
    const UvMetric metric{.e_mm2 = float(s * (a * v2 * v2 - 2 * b * v1 * v2 + c * v1 * v1)),
                          .f_mm2 = float(s * (-a * u2 * v2 + b * (u1 * v2 + u2 * v1) - c * u1 * v1)),
                          .g_mm2 = float(s * (a * u2 * u2 - 2 * b * u1 * u2 + c * u1 * u1))};
    return std::isfinite(metric.e_mm2 + metric.f_mm2 + metric.g_mm2) ? metric : UvMetric{};
}

// Vertices that differ only in their normals share a place in the UV layout.
Weld weld_places(const Mesh& mesh) {
    std::vector<uint32_t> words;
    for (size_t i = 0; i < mesh.positions_mm.size(); ++i)
        for (const float value : {mesh.positions_mm[i].x, mesh.positions_mm[i].y, mesh.positions_mm[i].z,
                                  mesh.uvs[i].x, mesh.uvs[i].y})
            words.push_back(weld_key(value));
    return weld_records(words, 5);
}

}  // namespace

float UvMetric::mm_per_u() const {
    return std::sqrt(e_mm2);
}
float UvMetric::mm_per_v() const {
    return std::sqrt(g_mm2);
}

float UvMetric::mm_per_uv() const {
    const double det = double(e_mm2) * g_mm2 - double(f_mm2) * f_mm2;
    return det > 0 ? float(std::sqrt(std::sqrt(det))) : 0.0f;
}

float UvMetric::anisotropy() const {
    // The squared singular values are the eigenvalues m +- r of the form.
    const double m = (double(e_mm2) + g_mm2) / 2, half = (double(e_mm2) - g_mm2) / 2;
    const double r = std::sqrt(half * half + double(f_mm2) * f_mm2);
    if (m <= 0) return 0;
    return float(std::sqrt((m + r) / std::max(m - r, 1e-12 * m)));
}

std::vector<UvMetric> triangle_uv_metrics(const Mesh& mesh) {
    std::vector<UvMetric> metrics;
    metrics.reserve(mesh.triangle_count());
    for (size_t i = 0; i < mesh.indices.size(); i += 3) metrics.push_back(metric_of(mesh, i));
    return metrics;
}

std::vector<float> triangle_areas_mm2(const Mesh& mesh) {
    std::vector<float> areas;
    areas.reserve(mesh.triangle_count());
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const Vec3 a = mesh.positions_mm[mesh.indices[i]];
        areas.push_back(length(cross(mesh.positions_mm[mesh.indices[i + 1]] - a,
                                     mesh.positions_mm[mesh.indices[i + 2]] - a)) /
                        2);
    }
    return areas;
}

std::vector<UvMetric> vertex_uv_metrics(const Mesh& mesh) {
    const std::vector<UvMetric> triangles = triangle_uv_metrics(mesh);
    const std::vector<float> areas = triangle_areas_mm2(mesh);
    const Weld weld = weld_places(mesh);
    std::vector<UvMetric> sums(weld.count());
    std::vector<float> weights(weld.count(), 0.0f);
    for (size_t corner = 0; corner < mesh.indices.size(); ++corner) {
        const UvMetric& metric = triangles[corner / 3];
        if (metric.e_mm2 == 0) continue;
        const uint32_t id = weld.ids[mesh.indices[corner]];
        const float area = areas[corner / 3];
        sums[id].e_mm2 += area * metric.e_mm2;
        sums[id].f_mm2 += area * metric.f_mm2;
        sums[id].g_mm2 += area * metric.g_mm2;
        weights[id] += area;
    }
    std::vector<UvMetric> metrics;
    metrics.reserve(weld.ids.size());
    for (const uint32_t id : weld.ids) {
        const float scale = weights[id] > 0 ? 1 / weights[id] : 0.0f;
        metrics.push_back({sums[id].e_mm2 * scale, sums[id].f_mm2 * scale, sums[id].g_mm2 * scale});
    }
    return metrics;
}

UvDerivatives vertex_uv_derivatives(const Mesh& mesh) {
    const Weld weld = weld_places(mesh);
    const std::vector<float> areas = triangle_areas_mm2(mesh);
    std::vector<Vec3> du(weld.count()), dv(weld.count());
    std::vector<float> weights(weld.count(), 0.0f);
    for (size_t first = 0; first < mesh.indices.size(); first += 3) {
        const uint32_t* corner = &mesh.indices[first];
        const Vec2 uv1 = mesh.uvs[corner[1]] - mesh.uvs[corner[0]],
                   uv2 = mesh.uvs[corner[2]] - mesh.uvs[corner[0]];
        const Vec3 d1 = mesh.positions_mm[corner[1]] - mesh.positions_mm[corner[0]],
                   d2 = mesh.positions_mm[corner[2]] - mesh.positions_mm[corner[0]];
        const float det = cross(uv1, uv2);
        if (!(std::abs(det) > 1e-20f)) continue;
        const float area = areas[first / 3];
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t id = weld.ids[corner[k]];
            du[id] += (d1 * uv2.y - d2 * uv1.y) * (area / det);
            dv[id] += (d2 * uv1.x - d1 * uv2.x) * (area / det);
            weights[id] += area;
        }
    }
    UvDerivatives result;
    for (const uint32_t id : weld.ids) {
        const float scale = weights[id] > 0 ? 1 / weights[id] : 0.0f;
        result.du_mm.push_back(du[id] * scale), result.dv_mm.push_back(dv[id] * scale);
    }
    return result;
}

}  // namespace dermis::inline mesh
