#include "subjects/bust/charts.h"

#include <algorithm>
#include <map>
#include <queue>

#include "dermis/base/parallel.h"
#include "dermis/mesh/topology.h"
#include "subjects/bust/remesh.h"

namespace dermis::bust {
namespace {

using Labels = std::vector<int>;

int label(const BustField& field, Point p_world) {
    const Point p = field.to_standard(p_world);
    if (on_cut(p)) return int(ChartKind::underside);
    if (field.on_ear(p)) return int(p.x > 0 ? ChartKind::left_ear : ChartKind::right_ear);
    return int(ChartKind::head);
}

// Smooths the borders: a face takes the label that two of its neighbours have.
void smooth(Labels& labels, const HalfEdges& edges) {
    for (int round = 0; round < 6; ++round) {
        Labels next = labels;
        for (size_t f = 0; f < labels.size(); ++f) {
            const int a = labels[edges.twin[3 * f] / 3], b = labels[edges.twin[3 * f + 1] / 3],
                      c = labels[edges.twin[3 * f + 2] / 3];
            if (a == b || a == c)
                next[f] = a;
            else if (b == c)
                next[f] = b;
        }
        labels.swap(next);
    }
}

// Keeps each label's largest piece; the others take the label around them.
void unite(Labels& labels, const HalfEdges& edges) {
    for (int round = 0; round < 4; ++round) {
        std::vector<int> piece(labels.size(), -1), size;
        std::vector<int> best(kChartCount, -1);
        for (size_t seed = 0; seed < labels.size(); ++seed) {
            if (piece[seed] >= 0) continue;
            const int id = int(size.size());
            size.push_back(0);
            std::vector<int> stack = {int(seed)};
            piece[seed] = id;
            while (!stack.empty()) {
                const int f = stack.back();
                stack.pop_back();
                ++size[id];
                for (int k = 0; k < 3; ++k) {
                    const int g = edges.twin[3 * f + k] / 3;
                    if (piece[g] < 0 && labels[g] == labels[f]) piece[g] = id, stack.push_back(g);
                }
            }
            int& top = best[labels[seed]];
            if (top < 0 || size[id] > size[top]) top = id;
        }
        bool changed = false;
        std::vector<int> adopted(size.size(), -1);
        for (size_t f = 0; f < labels.size(); ++f) {
            if (piece[f] == best[labels[f]]) continue;
            for (int k = 0; k < 3; ++k) {
                const int g = edges.twin[3 * f + k] / 3;
                if (piece[g] != piece[f] && piece[g] == best[labels[g]]) adopted[piece[f]] = labels[g];
            }
        }
        for (size_t f = 0; f < labels.size(); ++f)
            if (adopted[piece[f]] >= 0) labels[f] = adopted[piece[f]], changed = true;
        if (!changed) return;
    }
}

// Straightens the edges between two labels, then moves the neighbouring vertices. A move that would leave a
// sliver is not made.
void straighten(Surface& surface, const Labels& labels, const HalfEdges& edges, const BustField& field) {
    constexpr double kLeastTwiceAreaMm2 = 0.03;
    const size_t n = surface.points.size();
    std::vector<std::vector<int>> along(n), around(n), faces(n);
    for (size_t h = 0; h < edges.twin.size(); ++h) {
        const auto& t = surface.triangles[h / 3];
        const int a = t[h % 3], b = t[(h % 3 + 1) % 3];
        around[size_t(a)].push_back(b);
        faces[size_t(a)].push_back(int(h / 3));
        if (labels[h / 3] != labels[size_t(edges.twin[h] / 3)]) along[size_t(a)].push_back(b);
    }
    std::vector<char> beside(n, 0);
    for (size_t v = 0; v < n; ++v)
        if (!along[v].empty())
            for (const int w : around[v]) beside[size_t(w)] = along[size_t(w)].empty();
    const auto is_sliver = [&](int f) {
        const auto& t = surface.triangles[size_t(f)];
        const Point a = surface.points[size_t(t[0])];
        return length(cross(surface.points[size_t(t[1])] - a, surface.points[size_t(t[2])] - a)) <
               kLeastTwiceAreaMm2;
    };
    const auto relax = [&](const std::vector<int>& ring, size_t v, double weight) {
        Point sum = {0, 0, 0};
        for (const int w : ring) sum = sum + surface.points[size_t(w)];
        const Point before = surface.points[v];
        surface.points[v] = field.project(mix(before, sum * (1.0 / double(ring.size())), weight), 2);
        if (std::ranges::any_of(faces[v], is_sliver)) surface.points[v] = before;
    };
    for (int round = 0; round < 8; ++round) {
        for (size_t v = 0; v < n; ++v)
            if (along[v].size() == 2) relax(along[v], v, 0.5);
        for (size_t v = 0; v < n; ++v)
            if (beside[v]) relax(around[v], v, 0.3);
    }
}

// The seam as half-edges: the shortest path from the underside's rim at the nape to the crown, with lower
// costs near the midline.
std::vector<int> back_seam(const Surface& surface, const HalfEdges& edges, const Labels& labels) {
    const size_t n = surface.points.size();
    std::vector<std::vector<int>> outgoing(n);
    std::vector<char> rim(n, 0);
    for (size_t h = 0; h < edges.twin.size(); ++h) {
        if (labels[h / 3] != int(ChartKind::head)) continue;
        const int v = surface.triangles[h / 3][h % 3];
        if (labels[edges.twin[h] / 3] == int(ChartKind::underside)) rim[v] = 1;
        outgoing[v].push_back(int(h));
    }
    int goal = -1;
    double nearest_goal = 1e18;
    for (size_t v = 0; v < n; ++v) {
        const Point p = surface.points[v];
        const double d = length(p - Point{0, 134, -8});
        if (d < nearest_goal) nearest_goal = d, goal = int(v);
    }
    std::vector<double> cost(n, 1e18);
    std::vector<int> came(n, -1);
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    // From anywhere on the rim's back, rather than its middle vertex, which may have no neighbour off the
    // rim.
    for (size_t v = 0; v < n; ++v)
        if (rim[v] && surface.points[v].z < 0)
            queue.push({cost[v] = 8 * std::abs(surface.points[v].x), int(v)});
    while (!queue.empty()) {
        const auto [c, v] = queue.top();
        queue.pop();
        if (c > cost[v] || v == goal) continue;
        for (const int h : outgoing[v]) {
            const auto& t = surface.triangles[h / 3];
            const int w = t[(h % 3 + 1) % 3];
            if (rim[w]) continue;
            const Point p = surface.points[w];
            const double step =
                length(p - surface.points[v]) * (1 + 0.15 * std::abs(p.x) + (p.z > 20 ? 5 : 0));
            if (c + step < cost[w]) {
                cost[w] = c + step;
                came[w] = h;
                queue.push({cost[w], w});
            }
        }
    }
    std::vector<int> seam;
    for (int v = goal; came[v] >= 0; v = surface.triangles[seam.back() / 3][seam.back() % 3])
        seam.push_back(came[v]);
    return seam;
}

// An inner edge between two boundary vertices would lie along the flat chart's rim: it gets a vertex of its
// own.
void split_chords(Surface& mesh, const BustField& field) {
    for (bool again = true; again;) {
        again = false;
        const HalfEdges edges(mesh);
        std::vector<char> rim(mesh.points.size(), 0), touched(mesh.triangles.size(), 0);
        for (size_t h = 0; h < edges.twin.size(); ++h)
            if (edges.twin[h] < 0)
                rim[mesh.triangles[h / 3][h % 3]] = rim[mesh.triangles[h / 3][(h % 3 + 1) % 3]] = 1;
        for (int h = 0; h < int(edges.twin.size()); ++h) {
            const int t = edges.twin[h];
            if (t < h) continue;
            // `edges` is stale for a triangle that was split: next round.
            if (touched[h / 3] || touched[t / 3]) continue;
            const auto corner = [&](int e, int k) { return mesh.triangles[e / 3][(e % 3 + k) % 3]; };
            const int a = corner(h, 0), b = corner(h, 1), c = corner(h, 2), d = corner(t, 2);
            if (!rim[a] || !rim[b]) continue;
            again = true;
            touched[h / 3] = touched[t / 3] = 1;
            const int m = int(mesh.points.size());
            mesh.points.push_back(field.project((mesh.points[a] + mesh.points[b]) * 0.5, 2));
            mesh.triangles[h / 3] = {a, m, c};
            mesh.triangles[t / 3] = {b, m, d};
            mesh.triangles.push_back({m, b, c});
            mesh.triangles.push_back({m, a, d});
        }
    }
}

}  // namespace

std::vector<std::vector<int>> boundary_loops(const Surface& surface) {
    const HalfEdges edges(surface);
    std::map<int, int> following;
    for (size_t h = 0; h < edges.twin.size(); ++h)
        if (edges.twin[h] < 0)
            following[surface.triangles[h / 3][h % 3]] = surface.triangles[h / 3][(h % 3 + 1) % 3];
    std::vector<std::vector<int>> loops;
    while (!following.empty()) {
        std::vector<int> loop;
        for (auto at = following.begin(); at != following.end();) {
            loop.push_back(at->first);
            const int to = at->second;
            following.erase(at);
            at = following.find(to);
        }
        loops.push_back(std::move(loop));
    }
    const auto size_mm = [&](const std::vector<int>& loop) {
        double sum = 0;
        for (size_t i = 0; i < loop.size(); ++i)
            sum += length(surface.points[loop[i]] - surface.points[loop[(i + 1) % loop.size()]]);
        return sum;
    };
    std::sort(loops.begin(), loops.end(),
              [&](const auto& a, const auto& b) { return size_mm(a) > size_mm(b); });
    return loops;
}

std::vector<Chart> cut_charts(Surface surface, const BustField& field) {
    const HalfEdges edges(surface);
    Labels labels(surface.triangles.size());
    parallel_for(labels.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t f = begin; f < end; ++f) {
            const auto& t = surface.triangles[f];
            labels[f] = label(
                field, (surface.points[t[0]] + surface.points[t[1]] + surface.points[t[2]]) * (1.0 / 3));
        }
    });
    smooth(labels, edges);
    unite(labels, edges);
    straighten(surface, labels, edges, field);
    const std::vector<int> seam = back_seam(surface, edges, labels);
    std::vector<char> cut(edges.twin.size(), 0);
    for (const int h : seam) cut[h] = cut[edges.twin[h]] = 1;

    // Corners of triangles that meet across an uncut edge are one vertex.
    DisjointSets vertices(edges.twin.size());
    const auto find = [&](int h) { return vertices.find(uint32_t(h)); };
    const auto next = [](int h) { return int(next_corner(uint32_t(h))); };
    for (int h = 0; h < int(edges.twin.size()); ++h) {
        const int t = edges.twin[h];
        if (cut[h] || labels[h / 3] != labels[t / 3]) continue;
        vertices.join(uint32_t(h), uint32_t(next(t)));
        vertices.join(uint32_t(next(h)), uint32_t(t));
    }
    std::vector<Chart> charts(kChartCount);
    std::vector<int> id(edges.twin.size(), -1);
    for (size_t f = 0; f < labels.size(); ++f) {
        Chart& chart = charts[labels[f]];
        chart.kind = ChartKind(labels[f]);
        std::array<int, 3> t;
        for (int k = 0; k < 3; ++k) {
            int& i = id[find(int(3 * f) + k)];
            if (i < 0) {
                i = int(chart.mesh.points.size());
                chart.mesh.points.push_back(surface.points[surface.triangles[f][k]]);
            }
            t[k] = i;
        }
        chart.mesh.triangles.push_back(t);
    }
    // The head's corners: both ends of the seam's foot, in the order of the boundary. An ear lies on its
    // front edge.
    charts[int(ChartKind::head)].corners = {id[find(next(edges.twin[seam.back()]))], id[find(seam.back())]};
    for (Chart& chart : charts) {
        if (chart.kind == ChartKind::head) continue;
        const Point corner = chart.kind == ChartKind::left_ear ? field.ear().to_head({-6, 22, 0})
                             : chart.kind == ChartKind::right_ear
                                 ? mirrored(field.ear().to_head({-7, -26, 0}))
                                 : Point{-120, -190, -90};
        const std::vector<int> rim = boundary_loops(chart.mesh)[0];
        const auto away = [&](int i) { return length(chart.mesh.points[i] - corner); };
        chart.corners = {
            *std::min_element(rim.begin(), rim.end(), [&](int a, int b) { return away(a) < away(b); })};
    }
    for (Chart& chart : charts) split_chords(chart.mesh, field);
    return charts;
}

}  // namespace dermis::bust
