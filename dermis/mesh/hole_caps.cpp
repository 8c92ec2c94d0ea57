#include "dermis/mesh/hole_caps.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "dermis/mesh/topology.h"

namespace dermis::inline mesh {
namespace {

struct Edge {
    uint32_t from, to;
    friend auto operator<=>(const Edge&, const Edge&) = default;
};

double area_of(Vec3 a, Vec3 b, Vec3 c) {
    return 0.5 * double(length(cross(b - a, c - a)));
}

// Edges without a partner that runs the other way, by where they start.
std::vector<Edge> border_edges(std::vector<Edge> edges) {
    std::ranges::sort(edges);
    std::vector<Edge> border;
    for (size_t i = 0; i < edges.size(); ++i) {
        const Edge back{edges[i].to, edges[i].from};
        const auto same = std::equal_range(edges.begin(), edges.end(), edges[i]);
        const auto partners = std::equal_range(edges.begin(), edges.end(), back);
        // Among equal edges, as many are open as lack a partner.
        const auto number = edges.begin() + std::ptrdiff_t(i) - same.first;
        if (number >= partners.second - partners.first) border.push_back(edges[i]);
    }
    return border;
}

// The edges that start at each vertex, lowest first. An edge is found in constant time, however many borders
// meet at its vertex.
class EdgesLeft {
  public:
    EdgesLeft(std::span<const Edge> border, size_t vertices)
        : border_(border), next_(vertices, border.size()) {
        for (size_t edge = border.size(); edge-- > 0;) next_[border[edge].from] = edge;
    }
    // border.size(): none is left.
    size_t take(uint32_t from) {
        const size_t edge = next_[from];
        if (edge == border_.size()) return edge;
        const size_t after = edge + 1;
        next_[from] = after < border_.size() && border_[after].from == from ? after : border_.size();
        return edge;
    }
    [[nodiscard]] bool is_left(size_t edge) const { return next_[border_[edge].from] <= edge; }

  private:
    std::span<const Edge> border_;
    std::vector<size_t> next_;
};

std::vector<BorderLoop> loops_of(std::span<const Edge> border, std::span<const Vec3> positions_mm,
                                 const Weld& weld) {
    EdgesLeft left(border, weld.count());
    std::vector<BorderLoop> loops;
    for (const Edge& first : border) {
        if (!left.is_left(size_t(&first - border.data()))) continue;
        BorderLoop loop;
        uint32_t vertex = first.from;
        do {
            const size_t edge = left.take(vertex);
            if (edge == border.size()) {  // a chain that does not close
                loop.clear();
                break;
            }
            loop.push_back(positions_mm[weld.first[vertex]]);
            vertex = border[edge].to;
        } while (vertex != first.from);
        if (loop.size() >= 3) loops.push_back(std::move(loop));
    }
    return loops;
}

// Smallest areas of the polygons from vertex i to vertex k, and the vertex between them that gives it.
struct Table {
    size_t count;
    std::vector<double> area;
    std::vector<uint32_t> between;
    explicit Table(size_t n) : count(n), area(n * n), between(n * n) {}
    [[nodiscard]] size_t at(size_t i, size_t k) const { return i * count + k; }
};

std::vector<std::array<Vec3, 3>> smallest_cap(const BorderLoop& loop) {
    const size_t n = loop.size();
    Table table(n);
    for (size_t span = 2; span < n; ++span)
        for (size_t i = 0; i + span < n; ++i) {
            const size_t k = i + span;
            double best = std::numeric_limits<double>::infinity();
            for (size_t m = i + 1; m < k; ++m) {
                const double area = table.area[table.at(i, m)] + table.area[table.at(m, k)] +
                                    area_of(loop[i], loop[m], loop[k]);
                if (area < best) best = area, table.between[table.at(i, k)] = uint32_t(m);
            }
            table.area[table.at(i, k)] = best;
        }
    std::vector<std::array<Vec3, 3>> triangles;
    std::vector<std::array<size_t, 2>> open = {{0, n - 1}};
    while (!open.empty()) {
        const auto [i, k] = open.back();
        open.pop_back();
        if (k < i + 2) continue;
        const size_t m = table.between[table.at(i, k)];
        // The border turns with its own triangles; what continues them turns the other way.
        triangles.push_back({loop[i], loop[k], loop[m]});
        open.push_back({i, m});
        open.push_back({m, k});
    }
    return triangles;
}

}  // namespace

std::vector<BorderLoop> border_loops(std::span<const Vec3> positions_mm, std::span<const uint32_t> indices,
                                     std::span<const uint32_t> triangles) {
    const Weld weld = weld_positions(positions_mm);
    std::vector<Edge> edges;
    for (const uint32_t triangle : triangles)
        for (uint32_t i = 0; i < 3; ++i) {
            const Edge edge{weld.ids[indices[3 * triangle + i]],
                            weld.ids[indices[3 * triangle + (i + 1) % 3]]};
            if (edge.from != edge.to) edges.push_back(edge);
        }
    return loops_of(border_edges(std::move(edges)), positions_mm, weld);
}

bool LoopOrder::operator()(const BorderLoop& a, const BorderLoop& b) const {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), [](Vec3 p, Vec3 q) {
        return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
    });
}

size_t affordable_exact(std::span<const BorderLoop> loops) {
    constexpr double kMostSteps = 2e9;
    constexpr size_t kSmallest = 16;
    const auto steps = [&](size_t largest) {
        double sum = 0;
        for (const BorderLoop& loop : loops) {
            const auto n = double(std::min(loop.size(), largest));
            sum += n * n * n / 6;
        }
        return sum;
    };
    size_t largest = kLargestExactLoop;
    while (largest > kSmallest && steps(largest) > kMostSteps) largest /= 2;
    return largest;
}

std::vector<std::array<Vec3, 3>> cap_of(const BorderLoop& loop, size_t largest_exact) {
    BorderLoop rest = loop;
    std::vector<std::array<Vec3, 3>> triangles;
    while (rest.size() > largest_exact) {
        BorderLoop kept;
        for (size_t i = 0; i < rest.size(); ++i) {
            if (i % 2 == 0 || i + 1 == rest.size())
                kept.push_back(rest[i]);
            else
                triangles.push_back({rest[i - 1], rest[i + 1], rest[i]});
        }
        rest = std::move(kept);
    }
    const std::vector<std::array<Vec3, 3>> inner = smallest_cap(rest);
    triangles.insert(triangles.end(), inner.begin(), inner.end());
    return triangles;
}

}  // namespace dermis::inline mesh
