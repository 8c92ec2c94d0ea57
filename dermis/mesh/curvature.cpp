// Around every position: gather a neighbourhood, write its points as heights over the tangent plane, fit
// z = a + b x + c y + d x^2/2 + e x y + f y^2/2 + (d + f) z^2/4, and take H from the derivatives at the foot.
// The last term, of third order at most, makes spheres exact, which a parabola is not over more than a few
// degrees.

#include "dermis/mesh/curvature.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>

#include "dermis/base/parallel.h"
#include "dermis/mesh/topology.h"

namespace dermis {
namespace {

constexpr size_t kMaxNeighbours = 1500;
constexpr int kTerms = 6;
using Terms = Eigen::Matrix<double, kTerms, 1>;

struct Graph {
    std::vector<uint32_t> first, neighbours;  // of position i: neighbours[first[i] .. first[i + 1])
    [[nodiscard]] std::span<const uint32_t> around(uint32_t i) const {
        return std::span(neighbours).subspan(first[i], first[i + 1] - first[i]);
    }
};

Graph edges_of(std::span<const uint32_t> positions, size_t count) {
    const CornerTable table(positions, count);
    Graph graph;
    std::vector<uint32_t> ring;
    for (uint32_t i = 0; i < count; ++i) {
        graph.first.push_back(uint32_t(graph.neighbours.size()));
        ring.clear();
        for (const uint32_t corner : table.corners(i))
            for (const uint32_t other : {positions[next_corner(corner)], positions[previous_corner(corner)]})
                if (other != i) ring.push_back(other);
        std::ranges::sort(ring);
        ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
        graph.neighbours.insert(graph.neighbours.end(), ring.begin(), ring.end());
    }
    graph.first.push_back(uint32_t(graph.neighbours.size()));
    return graph;
}

struct Surface {
    std::vector<Vec3> positions, normals;  // welded; normals unit
    std::vector<float> areas;              // a third of the triangles around, mm^2
    Graph graph;
};

Surface weld_surface(const Mesh& mesh, const Weld& weld) {
    Surface surface;
    surface.normals.resize(weld.count());
    surface.areas.resize(weld.count());
    for (const uint32_t vertex : weld.first) surface.positions.push_back(mesh.positions_mm[vertex]);
    for (size_t i = 0; i < mesh.normals.size(); ++i) surface.normals[weld.ids[i]] += mesh.normals[i];
    for (Vec3& n : surface.normals) n = normalize(n);
    const std::vector<uint32_t> positions = welded_indices(mesh.indices, weld);
    for (size_t i = 0; i < positions.size(); i += 3) {
        const Vec3 a = surface.positions[positions[i]];
        const float area =
            length(cross(surface.positions[positions[i + 1]] - a, surface.positions[positions[i + 2]] - a)) /
            6;
        for (size_t k = 0; k < 3; ++k) surface.areas[positions[i + k]] += area;
    }
    surface.graph = edges_of(positions, weld.count());
    return surface;
}

struct Neighbour {
    uint32_t position;
    float distance_mm;  // along edges
};

// Walks outwards in order of distance. One per thread: its marks are reused.
class Walker {
  public:
    explicit Walker(const Surface& surface) : surface_(surface), mark_(surface.positions.size(), 0) {}

    std::span<const Neighbour> rings(uint32_t centre, int count) {
        start(centre);
        size_t begin = 0;
        for (int ring = 0; ring < count; ++ring) {
            const size_t end = found_.size();
            for (size_t i = begin; i < end && found_.size() < kMaxNeighbours; ++i)
                for (const uint32_t next : surface_.graph.around(found_[i].position))
                    if (visit(centre, next))
                        found_.push_back(
                            {next, length(surface_.positions[next] - surface_.positions[centre])});
            begin = end;
        }
        return found_;
    }

    // Dijkstra over edges up to the radius.
    std::span<const Neighbour> within(uint32_t centre, float radius_mm) {
        start(centre);
        found_.clear();
        std::priority_queue<std::pair<float, uint32_t>, std::vector<std::pair<float, uint32_t>>,
                            std::greater<>>
            open;
        open.push({0, centre});
        ++generation_;
        while (!open.empty() && found_.size() < kMaxNeighbours) {
            const auto [distance, at] = open.top();
            open.pop();
            if (mark_[at] == generation_) continue;
            mark_[at] = generation_;
            if (!same_side(centre, at)) continue;
            found_.push_back({at, distance});
            for (const uint32_t next : surface_.graph.around(at)) {
                const float there = distance + length(surface_.positions[next] - surface_.positions[at]);
                if (there <= radius_mm && mark_[next] != generation_) open.push({there, next});
            }
        }
        return found_;
    }

  private:
    void start(uint32_t centre) {
        ++generation_;
        mark_[centre] = generation_;
        found_ = {{centre, 0}};
    }
    // Behind a fold the surface is no height field over this plane.
    [[nodiscard]] bool same_side(uint32_t centre, uint32_t at) const {
        return at == centre || dot(surface_.normals[centre], surface_.normals[at]) > 0;
    }
    bool visit(uint32_t centre, uint32_t at) {
        if (mark_[at] == generation_) return false;
        mark_[at] = generation_;
        return same_side(centre, at);
    }

    const Surface& surface_;
    std::vector<uint32_t> mark_;
    uint32_t generation_ = 0;
    std::vector<Neighbour> found_;
};

// Nothing when the points do not determine the surface: a pivot of Cholesky's factor is close to 0.
std::optional<Terms> solve(const Eigen::Matrix<double, kTerms, kTerms>& lower, const Terms& rhs) {
    const Eigen::LLT<Eigen::Matrix<double, kTerms, kTerms>> factor(lower);
    if (factor.info() != Eigen::Success) return std::nullopt;
    const Terms pivots = factor.matrixLLT().diagonal().array().square();
    if (!(pivots.array() > 1e-10 * lower.diagonal().array()).all()) return std::nullopt;
    return factor.solve(rhs);
}

// H of the graph of z(x, y), positive where it bends away from the normal.
double mean_curvature(double zx, double zy, double zxx, double zxy, double zyy) {
    const double w = 1 + zx * zx + zy * zy;
    return -((1 + zy * zy) * zxx - 2 * zx * zy * zxy + (1 + zx * zx) * zyy) / (2 * w * std::sqrt(w));
}

float fit_at(const Surface& surface, uint32_t centre, std::span<const Neighbour> neighbours,
             double sigma_mm) {
    const Vec3 origin = surface.positions[centre], n = surface.normals[centre];
    const Vec3 x_axis = normalize(cross(std::abs(n.x) < 0.6f ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, n));
    const Vec3 y_axis = cross(n, x_axis);
    double scale = 0;  // lengths over the farthest neighbour: the terms then have like sizes
    for (const Neighbour& other : neighbours)
        scale = std::max(scale, double(length(surface.positions[other.position] - origin)));
    if (scale == 0) return 0;
    Eigen::Matrix<double, kTerms, kTerms> normal_matrix;
    normal_matrix.setZero();
    Terms rhs = Terms::Zero();
    for (const Neighbour& other : neighbours) {
        const Vec3 p = surface.positions[other.position] - origin;
        const double x = dot(p, x_axis) / scale, y = dot(p, y_axis) / scale, z = dot(p, n) / scale;
        // Unsmoothed, the foot itself counts most, so that the fit passes near it.
        const double t = other.distance_mm / (sigma_mm > 0 ? sigma_mm : 0.7 * scale);
        const double weight = std::exp(-t * t / 2) * (sigma_mm > 0 ? surface.areas[other.position] : 1);
        Terms terms;
        terms << 1, x, y, (x * x + z * z / 2) / 2, x * y, (y * y + z * z / 2) / 2;
        normal_matrix.selfadjointView<Eigen::Lower>().rankUpdate(terms, weight);
        rhs += weight * z * terms;
    }
    const std::optional<Terms> solved = solve(normal_matrix, rhs);
    if (!solved) return 0;
    // Implicit derivatives at the foot, where z = c[0].
    const Terms& c = *solved;
    const double s = (c[3] + c[5]) / 2, m = 1 - s * c[0];
    const double zx = c[1] / m, zy = c[2] / m;
    const double curvature =
        mean_curvature(zx, zy, (c[3] + s * zx * zx) / m, (c[4] + s * zx * zy) / m, (c[5] + s * zy * zy) / m) /
        scale;
    return std::isfinite(curvature) ? float(curvature) : 0.0f;
}

}  // namespace

std::vector<float> compute_curvature(const Mesh& mesh, double smoothing_mm) {
    const Weld weld = weld_positions(mesh.positions_mm);
    const Surface surface = weld_surface(mesh, weld);
    std::vector<float> welded(weld.count());
    // Large blocks: every one makes a walker, whose marks are as long as the mesh.
    parallel_for(weld.count(), 4096, [&](size_t begin, size_t end) {
        Walker walker(surface);
        for (size_t i = begin; i < end; ++i) {
            const auto centre = uint32_t(i);
            std::span<const Neighbour> around;
            double sigma_mm = smoothing_mm;
            if (smoothing_mm > 0) around = walker.within(centre, float(2 * smoothing_mm));
            if (around.size() < 12) around = walker.rings(centre, 2), sigma_mm = 0;
            welded[i] = fit_at(surface, centre, around, sigma_mm);
        }
    });
    std::vector<float> curvatures;
    curvatures.reserve(mesh.positions_mm.size());
    for (const uint32_t id : weld.ids) curvatures.push_back(welded[id]);
    return curvatures;
}

}  // namespace dermis
