// Region growing by normals, as in Lévy, Petitjean, Ray, Maillot 2002, "Least Squares Conformal Maps",
// section 3, with a plane per chart instead of a conformal map.

#include "dermis/mesh/unwrap.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

#include "dermis/mesh/topology.h"
#include "dermis/mesh/uv_texels.h"

namespace dermis::inline mesh {
namespace {

constexpr uint32_t kNoFace = ~0u;
// Normals of a chart around their mean.
constexpr float kCone_rad = 0.96f;
// Charts with less than these shares of the whole area join a neighbour: where they still share texels with
// none, and where they may share some.
constexpr double kSmallShare = 1e-3, kTinyShare = 2e-5;

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

// The mean moves while a chart grows: faces of charts from `first` on that the last mean is too far from
// leave them.
void release_steep(const Faces& faces, std::span<const Vec3> axes, uint32_t first, float least_cosine,
                   std::vector<uint32_t>& chart) {
    for (uint32_t i = 0; i < chart.size(); ++i)
        if (chart[i] != kNoFace && chart[i] >= first && cosine_to(faces, i, axes[chart[i]]) < least_cosine)
            chart[i] = kNoFace;
}

// Faces of charts with less than `share` of the whole area go to a neighbour that they can be projected with.
void absorb_small(const Faces& faces, std::span<const Vec3> axes, double share, float least_cosine,
                  std::vector<uint32_t>& chart) {
    std::vector<double> areas(axes.size(), 0);
    double total = 0;
    for (uint32_t i = 0; i < chart.size(); ++i)
        areas[chart[i]] += double(faces.areas_mm2[i]), total += double(faces.areas_mm2[i]);
    const auto is_small = [&](uint32_t face) { return areas[chart[face]] <= share * total; };
    for (int round = 0; round < 4; ++round)
        for (uint32_t i = 0; i < chart.size(); ++i) {
            if (!is_small(i)) continue;
            float best = least_cosine;
            uint32_t to = chart[i];
            for (const uint32_t next : faces.neighbours[i]) {
                if (next == kNoFace || is_small(next)) continue;
                const float cosine = cosine_to(faces, i, axes[chart[next]]);
                if (cosine > best) best = cosine, to = chart[next];
            }
            chart[i] = to;
        }
}

// A face in its chart's plane, in mm.
std::array<Vec2, 3> projected(const Mesh& mesh, uint32_t triangle, Vec3 axis) {
    const Vec3 t =
        normalize(std::abs(axis.x) < 0.7f ? cross(axis, Vec3{1, 0, 0}) : cross(axis, Vec3{0, 1, 0}));
    const Vec3 b = cross(axis, t);
    std::array<Vec2, 3> corners;
    for (size_t k = 0; k < 3; ++k) {
        const Vec3 p = mesh.positions_mm[mesh.indices[3 * size_t(triangle) + k]];
        corners[k] = {dot(p, t), -dot(p, b)};
    }
    return corners;
}

// Texels of a chart's plane, some for each face.
struct Plane {
    Vec2 low;
    double texels_per_mm = 1;
    int side = 0;
    std::vector<bool> taken;

    Plane(std::span<const std::array<Vec2, 3>> corners_mm, std::span<const uint32_t> faces) {
        Vec2 high = corners_mm[faces[0]][0];
        low = high;
        for (const uint32_t face : faces)
            for (const Vec2 p : corners_mm[face]) {
                low = {std::min(low.x, p.x), std::min(low.y, p.y)};
                high = {std::max(high.x, p.x), std::max(high.y, p.y)};
            }
        side = int(std::clamp(8 * std::sqrt(double(faces.size())), 256.0, 4096.0));
        texels_per_mm = side / double(std::max({high.x - low.x, high.y - low.y, 1e-6f}));
        taken.assign(size_t(side) * size_t(side), false);
    }
    // False, and nothing taken, where another face has a texel.
    bool take(const std::array<Vec2, 3>& corners_mm) {
        std::array<std::array<double, 2>, 3> corners;
        for (size_t k = 0; k < 3; ++k)
            corners[k] = {double(corners_mm[k].x - low.x) * texels_per_mm,
                          double(corners_mm[k].y - low.y) * texels_per_mm};
        bool is_free = true;
        std::vector<size_t> texels;
        visit_texels_of(corners, {side, side}, [&](int x, int y, double, double) {
            texels.push_back(size_t(y) * size_t(side) + size_t(x));
            is_free = is_free && !taken[texels.back()];
        });
        if (is_free)
            for (const size_t texel : texels) taken[texel] = true;
        return is_free;
    }
};

// Spreads over one chart from its largest face, ring by ring. Faces that it cannot reach without covering
// texels twice leave the chart.
void release_overlapping(const Faces& faces, std::span<const std::array<Vec2, 3>> corners_mm,
                         std::span<const uint32_t> members, std::vector<uint32_t>& chart) {
    constexpr uint32_t kWaits = kNoFace - 1;
    const uint32_t number = chart[members[0]];
    for (const uint32_t face : members) chart[face] = kWaits;
    Plane plane(corners_mm, members);
    std::queue<uint32_t> ring;
    ring.push(*std::ranges::max_element(members, {}, [&](uint32_t face) { return faces.areas_mm2[face]; }));
    while (!ring.empty()) {
        const uint32_t face = ring.front();
        ring.pop();
        if (chart[face] != kWaits) continue;
        chart[face] = plane.take(corners_mm[face]) ? number : kNoFace;
        if (chart[face] == kNoFace) continue;
        for (const uint32_t next : faces.neighbours[face])
            if (next != kNoFace) ring.push(next);
    }
    for (const uint32_t face : members)
        if (chart[face] == kWaits) chart[face] = kNoFace;
}

// Charts of the faces that have none; their numbers start at `first`.
void add_charts(const Faces& faces, float least_cosine, Unwrapping& result, std::vector<Vec3>& axes) {
    const uint32_t first = result.charts;
    std::vector<uint32_t> order;
    for (uint32_t i = 0; i < result.chart.size(); ++i)
        if (result.chart[i] == kNoFace) order.push_back(i);
    std::ranges::stable_sort(order, std::greater<>(), [&](uint32_t i) { return faces.areas_mm2[i]; });
    const auto grow_all = [&] {
        for (const uint32_t seed : order)
            if (result.chart[seed] == kNoFace) grow(faces, seed, result.charts++, least_cosine, result.chart);
    };
    const auto update_axes = [&] {
        std::vector<Vec3> all = chart_axes(faces, result.chart, result.charts);
        std::copy_n(axes.begin(), first, all.begin());
        axes = std::move(all);
    };
    grow_all();
    update_axes();
    release_steep(faces, axes, first, least_cosine, result.chart);
    grow_all();
    update_axes();
}

// The charts with at least `share` of the area, each from the face that its mean normal fits best. All grow
// at once, the best fit first, so that borders lie where two mean normals fit equally (Lloyd's iteration as
// in Cohen-Steiner, Alliez, Desbrun 2004, "Variational Shape Approximation", section 3). Other faces have
// none.
void regrow(const Faces& faces, double share, float least_cosine, Unwrapping& result,
            std::vector<Vec3>& axes) {
    axes = chart_axes(faces, result.chart, result.charts);
    std::vector<double> areas(result.charts, 0);
    std::vector<uint32_t> seeds(result.charts, kNoFace);
    double total = 0;
    for (uint32_t i = 0; i < result.chart.size(); ++i) {
        const uint32_t chart = result.chart[i];
        areas[chart] += double(faces.areas_mm2[i]), total += double(faces.areas_mm2[i]);
        if (faces.normals[i] == Vec3{}) continue;
        if (seeds[chart] == kNoFace ||
            cosine_to(faces, i, axes[chart]) > cosine_to(faces, seeds[chart], axes[chart]))
            seeds[chart] = i;
    }
    std::ranges::fill(result.chart, kNoFace);
    struct Candidate {
        float cosine;
        uint32_t face, chart;
        bool operator<(const Candidate& other) const { return cosine < other.cosine; }
    };
    std::priority_queue<Candidate> queue;
    uint32_t kept = 0;
    for (uint32_t chart = 0; chart < result.charts; ++chart) {
        if (seeds[chart] == kNoFace || areas[chart] < share * total) continue;
        axes[kept] = axes[chart];
        queue.push({1, seeds[chart], kept++});
    }
    result.charts = kept;
    axes.resize(kept);
    while (!queue.empty()) {
        const Candidate best = queue.top();
        queue.pop();
        if (result.chart[best.face] != kNoFace || best.cosine < least_cosine) continue;
        result.chart[best.face] = best.chart;
        for (const uint32_t next : faces.neighbours[best.face])
            if (next != kNoFace && result.chart[next] == kNoFace)
                queue.push({cosine_to(faces, next, axes[best.chart]), next, best.chart});
    }
}

}  // namespace

Unwrapping unwrap(const Mesh& mesh, std::span<const uint32_t> triangles) {
    constexpr int kRounds = 8, kLloydRounds = 6;
    constexpr double kSeedShare = 0.01;
    const Faces faces = find_faces(mesh, triangles);
    const float least_cosine = std::cos(kCone_rad);
    Unwrapping result{.corners_mm = std::vector<std::array<Vec2, 3>>(triangles.size()),
                      .chart = std::vector<uint32_t>(triangles.size(), kNoFace)};
    std::vector<Vec3> axes;
    const auto project = [&](uint32_t i) {
        result.corners_mm[i] = projected(mesh, triangles[i], axes[result.chart[i]]);
    };
    for (int round = 0; round < kRounds && std::ranges::count(result.chart, kNoFace) > 0; ++round) {
        const uint32_t first = result.charts;
        add_charts(faces, least_cosine, result, axes);
        for (int turn = 0; round == 0 && turn < kLloydRounds; ++turn) {
            regrow(faces, kSeedShare, least_cosine, result, axes);
            add_charts(faces, least_cosine, result, axes);
        }
        if (round == 0) absorb_small(faces, axes, kSmallShare, 0.5f * least_cosine, result.chart);
        std::vector<std::vector<uint32_t>> members(result.charts - first);
        for (uint32_t i = 0; i < triangles.size(); ++i)
            if (result.chart[i] >= first) project(i), members[result.chart[i] - first].push_back(i);
        if (round + 1 == kRounds) break;
        for (const std::vector<uint32_t>& of_chart : members)
            if (of_chart.size() > 1) release_overlapping(faces, result.corners_mm, of_chart, result.chart);
    }
    absorb_small(faces, axes, kTinyShare, 0.1f, result.chart);
    for (uint32_t i = 0; i < triangles.size(); ++i) project(i);
    return result;
}

}  // namespace dermis::inline mesh
