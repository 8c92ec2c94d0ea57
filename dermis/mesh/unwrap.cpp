// Region growing by normals, as in Lévy, Petitjean, Ray, Maillot 2002, "Least Squares Conformal Maps",
// section 3, with a plane per chart instead of a conformal map.

#include "dermis/mesh/unwrap.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <tuple>

#include "dermis/mesh/topology.h"

namespace dermis::inline mesh {
namespace {

constexpr uint32_t kNoFace = ~0u;
// Charts with less than this share of the whole area join a neighbour.
constexpr float kSmallChartShare = 1e-3f;

struct Faces {
    std::vector<Vec3> normals;  // of length 0 for triangles without area
    std::vector<float> areas_mm2;
    std::vector<std::array<uint32_t, 3>> neighbours;  // kNoFace at open edges
};

Faces find_faces(const Mesh& mesh, std::span<const uint32_t> triangles) {
    Faces faces;
    struct Edge {
        uint32_t a, b, corner;
    };
    const Weld weld = weld_positions(mesh.positions_mm);
    std::vector<Edge> edges;
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        const uint32_t* corner = &mesh.indices[3 * size_t(triangles[i])];
        const Vec3 p = mesh.positions_mm[corner[0]];
        const Vec3 twice = cross(mesh.positions_mm[corner[1]] - p, mesh.positions_mm[corner[2]] - p);
        const float l = length(twice);
        faces.normals.push_back(l > 0 ? twice * (1 / l) : Vec3{});
        faces.areas_mm2.push_back(l / 2);
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t a = weld.ids[corner[k]], b = weld.ids[corner[(k + 1) % 3]];
            edges.push_back({std::min(a, b), std::max(a, b), 3 * i + k});
        }
    }
    std::ranges::sort(edges, {}, [](const Edge& e) { return std::tuple(e.a, e.b, e.corner); });
    faces.neighbours.assign(triangles.size(), {kNoFace, kNoFace, kNoFace});
    for (size_t i = 1; i < edges.size(); ++i) {
        const Edge &x = edges[i - 1], &y = edges[i];
        if (x.a != y.a || x.b != y.b || faces.neighbours[x.corner / 3][x.corner % 3] != kNoFace) continue;
        faces.neighbours[x.corner / 3][x.corner % 3] = y.corner / 3;
        faces.neighbours[y.corner / 3][y.corner % 3] = x.corner / 3;
    }
    return faces;
}

// How far a face turns away from a direction; faces without area fit anywhere.
float cosine_to(const Faces& faces, uint32_t face, Vec3 direction) {
    return faces.normals[face] == Vec3{} ? 1 : dot(faces.normals[face], direction);
}

// Grows one chart from `seed` over faces without a chart.
void grow(const Faces& faces, uint32_t seed, uint32_t number, float least_cosine,
          std::vector<uint32_t>& chart) {
    Vec3 sum = faces.normals[seed] * faces.areas_mm2[seed];
    std::priority_queue<std::pair<float, uint32_t>> queue;
    queue.push({1, seed});
    while (!queue.empty()) {
        const uint32_t face = queue.top().second;
        queue.pop();
        if (chart[face] != kNoFace || cosine_to(faces, face, normalize(sum)) < least_cosine) continue;
        chart[face] = number;
        if (face != seed) sum += faces.normals[face] * faces.areas_mm2[face];
        for (const uint32_t next : faces.neighbours[face])
            if (next != kNoFace && chart[next] == kNoFace)
                queue.push({cosine_to(faces, next, normalize(sum)), next});
    }
}

std::vector<Vec3> chart_axes(const Faces& faces, std::span<const uint32_t> chart, uint32_t charts) {
    std::vector<Vec3> axes(charts);
    for (uint32_t i = 0; i < chart.size(); ++i)
        if (chart[i] != kNoFace) axes[chart[i]] += faces.normals[i] * faces.areas_mm2[i];
    for (Vec3& axis : axes) axis = dot(axis, axis) > 0 ? normalize(axis) : Vec3{0, 0, 1};
    return axes;
}

// The mean moves while a chart grows: faces that the last mean is too far from leave it.
void release_steep(const Faces& faces, std::span<const Vec3> axes, float least_cosine,
                   std::vector<uint32_t>& chart) {
    for (uint32_t i = 0; i < chart.size(); ++i)
        if (chart[i] != kNoFace && cosine_to(faces, i, axes[chart[i]]) < least_cosine) chart[i] = kNoFace;
}

// Faces of small charts go to a neighbour that they can be projected with.
void absorb_small(const Faces& faces, std::span<const Vec3> axes, float least_cosine,
                  std::vector<uint32_t>& chart) {
    std::vector<double> areas(axes.size(), 0);
    double total = 0;
    for (uint32_t i = 0; i < chart.size(); ++i)
        areas[chart[i]] += double(faces.areas_mm2[i]), total += double(faces.areas_mm2[i]);
    for (int round = 0; round < 4; ++round)
        for (uint32_t i = 0; i < chart.size(); ++i) {
            if (areas[chart[i]] > double(kSmallChartShare) * total) continue;
            float best = least_cosine;
            for (const uint32_t next : faces.neighbours[i]) {
                if (next == kNoFace || areas[chart[next]] <= double(kSmallChartShare) * total) continue;
                const float cosine = cosine_to(faces, i, axes[chart[next]]);
                if (cosine > best) best = cosine, chart[i] = chart[next];
            }
        }
}

}  // namespace

Unwrapping unwrap(const Mesh& mesh, std::span<const uint32_t> triangles, float cone_rad) {
    const Faces faces = find_faces(mesh, triangles);
    const float least_cosine = std::cos(cone_rad);
    Unwrapping result{.corners_mm = {}, .chart = std::vector<uint32_t>(triangles.size(), kNoFace)};
    std::vector<uint32_t> order(triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, std::greater<>(), [&](uint32_t i) { return faces.areas_mm2[i]; });
    std::vector<Vec3> axes;
    for (bool is_last : {false, true}) {
        for (const uint32_t seed : order)
            if (result.chart[seed] == kNoFace) grow(faces, seed, result.charts++, least_cosine, result.chart);
        axes = chart_axes(faces, result.chart, result.charts);
        if (!is_last) release_steep(faces, axes, least_cosine, result.chart);
    }
    absorb_small(faces, axes, 0.5f * least_cosine, result.chart);
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        const Vec3 n = axes[result.chart[i]];
        const Vec3 t = normalize(std::abs(n.x) < 0.7f ? cross(n, Vec3{1, 0, 0}) : cross(n, Vec3{0, 1, 0}));
        const Vec3 b = cross(n, t);
        std::array<Vec2, 3> corners;
        for (size_t k = 0; k < 3; ++k) {
            const Vec3 p = mesh.positions_mm[mesh.indices[3 * size_t(triangles[i]) + k]];
            corners[k] = {dot(p, t), -dot(p, b)};
        }
        result.corners_mm.push_back(corners);
    }
    return result;
}

}  // namespace dermis::inline mesh
