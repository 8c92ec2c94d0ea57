// Botsch & Kobbelt 2004, A remeshing approach to multiresolution modeling, section 4: split long edges,
// collapse short ones, flip towards valence 6, relax along the surface; here on a size that varies, and
// projected to the field.

#include "subjects/bust/remesh.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

#include "dermis/base/parallel.h"
#include "dermis/mesh/topology.h"

namespace dermis::bust {
namespace {

constexpr int next(int h) {
    return h % 3 == 2 ? h - 2 : h + 1;
}
constexpr int previous(int h) {
    return h % 3 == 0 ? h + 2 : h - 1;
}

class Remesher {
  public:
    Remesher(const Surface& surface, const RemeshTarget& target) : points_(surface.points), target_(target) {
        for (const auto& t : surface.triangles) from_.insert(from_.end(), t.begin(), t.end());
        twin_ = HalfEdges(surface).twin;
        out_.assign(points_.size(), -1);
        for (int h = 0; h < int(from_.size()); ++h) out_[from_[h]] = h;
        alive_.assign(from_.size() / 3, 1);
        measure();
    }

    void round() {
        split_long();
        collapse_short(4.0 / 5.0);
        flip();
        relax();
        relax();
    }

    /// Removes triangles that relaxation makes flat, in creases narrower than the wanted size.
    void tidy() {
        flip();
        for (int i = 0; i < 3; ++i) {
            collapse_short(0.3);
            remove_flat();
        }
    }

    [[nodiscard]] Surface result() const {
        Surface surface;
        std::vector<int> id(points_.size(), -1);
        for (size_t f = 0; f < alive_.size(); ++f) {
            if (!alive_[f]) continue;
            std::array<int, 3> t;
            for (int k = 0; k < 3; ++k) {
                int& i = id[from_[3 * f + k]];
                if (i < 0) {
                    i = int(surface.points.size());
                    surface.points.push_back(points_[from_[3 * f + k]]);
                }
                t[k] = i;
            }
            surface.triangles.push_back(t);
        }
        return surface;
    }

  private:
    [[nodiscard]] int to(int h) const { return from_[next(h)]; }
    [[nodiscard]] double edge(int h) const { return length(points_[from_[h]] - points_[to(h)]); }
    [[nodiscard]] double wish(int h) const { return 0.5 * (size_[from_[h]] + size_[to(h)]); }
    void link(int a, int b) {
        twin_[a] = b;
        twin_[b] = a;
    }
    [[nodiscard]] Point area(int a, int b, int c) const {
        return cross(points_[b] - points_[a], points_[c] - points_[a]);
    }
    template <class F>
    void around(int v, F&& f) const {  // outgoing half-edges of v
        const int first = out_[v];
        int h = first;
        do {
            f(h);
            h = twin_[previous(h)];
        } while (h != first);
    }
    [[nodiscard]] int valence(int v) const {
        int n = 0;
        around(v, [&](int) { ++n; });
        return n;
    }

    void measure() {
        size_.resize(points_.size());
        parallel_for(points_.size(), 2048, [&](size_t b, size_t e) {
            for (size_t i = b; i < e; ++i) size_[i] = target_.edge_mm(points_[i]);
        });
    }

    void split(int h) {
        const int t = twin_[h], a = from_[h], b = from_[t], c = from_[previous(h)], d = from_[previous(t)],
                  m = int(points_.size());
        points_.push_back((points_[a] + points_[b]) * 0.5);
        size_.push_back(0.5 * (size_[a] + size_[b]));
        const int hn = next(h), tn = next(t);
        const int hn_twin = twin_[hn], tn_twin = twin_[tn];
        // Faces (a b c), (b a d) become (a m c), (b m d) and the new (m b c), (m a d).
        const int f = int(from_.size()), g = f + 3;
        from_.insert(from_.end(), {m, b, c, m, a, d});
        twin_.insert(twin_.end(), 6, -1);
        alive_.insert(alive_.end(), 2, 1);
        from_[hn] = m;
        from_[tn] = m;
        link(h, g);            // a m | m a
        link(t, f);            // b m | m b
        link(f + 1, hn_twin);  // b c
        link(g + 1, tn_twin);  // a d
        link(hn, f + 2);       // m c | c m
        link(tn, g + 2);       // m d | d m
        out_.push_back(f);
        out_[a] = h;
        out_[b] = t;
    }

    void split_long() {
        // Longest first, in passes: a split appends its neighbours' edges to the list, so that one loop over
        // it might not end.
        struct Long {
            double excess;
            int h, a, b;
        };
        for (std::vector<Long> edges;; edges.clear()) {
            for (int h = 0; h < int(from_.size()); ++h) {
                const double excess = alive_[h / 3] && h < twin_[h] ? edge(h) / wish(h) : 0;
                if (excess > 4.0 / 3.0) edges.push_back({excess, h, from_[h], to(h)});
            }
            if (edges.empty()) return;
            std::sort(edges.begin(), edges.end(), [](const Long& p, const Long& q) {
                return p.excess != q.excess ? p.excess > q.excess : p.h < q.h;
            });
            for (const Long& e : edges)
                if (from_[e.h] == e.a && to(e.h) == e.b) split(e.h);
        }
    }

    [[nodiscard]] bool may_collapse(int h) const {
        const int a = from_[h], b = to(h), c = from_[previous(h)], d = from_[previous(twin_[h])];
        if (valence(c) <= 3 || valence(d) <= 3) return false;
        int shared = 0;
        around(a, [&](int x) { around(b, [&](int y) { shared += to(x) == to(y); }); });
        if (shared != 2) return false;
        const Point m = (points_[a] + points_[b]) * 0.5;
        bool fine = true;
        const auto check = [&](int v, int other) {
            around(v, [&](int x) {
                const int p = to(x), q = from_[previous(x)];
                if (p == other || q == other) return;
                const Point before = area(v, p, q), after = cross(points_[p] - m, points_[q] - m);
                if (dot(before, after) < 0.5 * length(before) * length(after) || length(after) < 1e-9)
                    fine = false;
                if (length(points_[p] - m) > 4.0 / 3.0 * 0.5 * (size_[p] + size_[v])) fine = false;
            });
        };
        check(a, b);
        check(b, a);
        return fine;
    }

    void collapse(int h) {  // a into b
        const int t = twin_[h], a = from_[h], b = to(h), c = from_[previous(h)], d = from_[previous(t)];
        points_[b] = (points_[a] + points_[b]) * 0.5;
        size_[b] = 0.5 * (size_[a] + size_[b]);
        std::vector<int> spokes;
        around(a, [&](int x) { spokes.push_back(x); });
        for (const int x : spokes) from_[x] = b;
        const int bc = twin_[next(h)], ca = twin_[previous(h)], ad = twin_[next(t)], db = twin_[previous(t)];
        link(bc, ca);
        link(ad, db);
        alive_[h / 3] = alive_[t / 3] = 0;
        out_[a] = -1;
        out_[c] = bc;  // c to b
        out_[b] = ca;  // once a to c
        out_[d] = ad;  // d to a, now d to b
        // `ca` is the twin of c to a: it runs from a, now b, to c.
    }

    void collapse_short(double least) {
        for (int h = 0; h < int(from_.size()); ++h)
            if (alive_[h / 3] && edge(h) < least * wish(h) && may_collapse(h)) collapse(h);
    }

    // Collapses the shortest edge of triangles with almost no height.
    void remove_flat() {
        for (int f = 0; f < int(alive_.size()); ++f) {
            if (!alive_[f]) continue;
            const int h = 3 * f;
            const double longest = std::max({edge(h), edge(h + 1), edge(h + 2)});
            if (length(area(from_[h], from_[h + 1], from_[h + 2])) > 0.08 * longest * longest) continue;
            int order[3] = {h, h + 1, h + 2};
            std::sort(order, order + 3, [&](int a, int b) { return edge(a) < edge(b); });
            for (const int e : order)
                if (may_collapse(e)) {
                    collapse(e);
                    break;
                }
        }
    }

    void flip() {
        for (int h = 0; h < int(from_.size()); ++h) {
            const int t = twin_[h];
            if (!alive_[h / 3] || h > t) continue;
            const int a = from_[h], b = to(h), c = from_[previous(h)], d = from_[previous(t)];
            const auto cost = [](int v) { return (v - 6) * (v - 6); };
            const int va = valence(a), vb = valence(b), vc = valence(c), vd = valence(d);
            const int now = cost(va) + cost(vb) + cost(vc) + cost(vd);
            const int then = cost(va - 1) + cost(vb - 1) + cost(vc + 1) + cost(vd + 1);
            if (then >= now || va <= 3 || vb <= 3) continue;
            bool joined = false;
            around(c, [&](int x) { joined |= to(x) == d; });
            if (joined) continue;
            const Point n = unit(area(a, b, c)) + unit(area(b, a, d));
            const Point p = area(a, d, c), q = area(b, c, d);
            if (dot(unit(p), unit(n)) < 0.7 || dot(unit(q), unit(n)) < 0.7) continue;
            flip_edge(h);
        }
    }

    void flip_edge(int h) {
        const int t = twin_[h], a = from_[h], b = from_[t], c = from_[previous(h)], d = from_[previous(t)];
        const int bc = twin_[next(h)], ca = twin_[previous(h)], ad = twin_[next(t)], db = twin_[previous(t)];
        // (a b c), (b a d) become (d c a), (c d b).
        const int h1 = next(h), h2 = previous(h), t1 = next(t), t2 = previous(t);
        from_[h] = d, from_[h1] = c, from_[h2] = a;
        from_[t] = c, from_[t1] = d, from_[t2] = b;
        link(h1, ca);
        link(h2, ad);
        link(t1, db);
        link(t2, bc);
        out_[a] = h2, out_[b] = t2, out_[c] = h1, out_[d] = t1;
    }

    void relax() {
        std::vector<Point> moved(points_.size());
        parallel_for(points_.size(), 512, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                if (out_[i] < 0) continue;
                // Centroid of the triangles around, weighted by area over wished area, then back along the
                // normal.
                Point center, normal;
                double weights = 0;
                around(int(i), [&](int h) {
                    const int p = to(h), q = from_[previous(h)];
                    const Point n = area(int(i), p, q);
                    const double s = (size_[i] + size_[p] + size_[q]) / 3, w = length(n) / (s * s);
                    center = center + (points_[i] + points_[p] + points_[q]) * (w / 3);
                    normal = normal + n;
                    weights += w;
                });
                normal = unit(normal);
                const Point step = center * (1 / std::max(weights, 1e-12)) - points_[i];
                moved[i] = target_.project(points_[i] + (step - normal * dot(step, normal)) * 0.8);
            }
        });
        points_.swap(moved);
        measure();
    }

    std::vector<Point> points_;
    std::vector<double> size_;
    std::vector<int> from_, twin_, out_;
    std::vector<char> alive_;
    const RemeshTarget& target_;
};

}  // namespace

Surface largest_piece(const Surface& surface) {
    DisjointSets pieces(surface.points.size());
    for (const auto& t : surface.triangles)
        pieces.join(uint32_t(t[0]), uint32_t(t[1])), pieces.join(uint32_t(t[1]), uint32_t(t[2]));
    std::vector<int> count(surface.points.size(), 0);
    for (const auto& t : surface.triangles) ++count[pieces.find(uint32_t(t[0]))];
    const auto best = uint32_t(std::max_element(count.begin(), count.end()) - count.begin());
    Surface kept;
    std::vector<int> id(surface.points.size(), -1);
    for (const auto& t : surface.triangles) {
        if (pieces.find(uint32_t(t[0])) != best) continue;
        std::array<int, 3> moved;
        for (int k = 0; k < 3; ++k) {
            if (id[t[k]] < 0) {
                id[t[k]] = int(kept.points.size());
                kept.points.push_back(surface.points[t[k]]);
            }
            moved[k] = id[t[k]];
        }
        kept.triangles.push_back(moved);
    }
    return kept;
}

HalfEdges::HalfEdges(const Surface& surface) : twin(surface.triangles.size() * 3, -1) {
    std::unordered_map<uint64_t, int> waiting;
    waiting.reserve(surface.triangles.size() * 2);
    for (size_t f = 0; f < surface.triangles.size(); ++f)
        for (int k = 0; k < 3; ++k) {
            const auto& t = surface.triangles[f];
            const uint64_t a = uint32_t(t[k]), b = uint32_t(t[(k + 1) % 3]);
            const int h = int(3 * f) + k;
            if (const auto other = waiting.find(b << 32 | a); other != waiting.end()) {
                twin[h] = other->second;
                twin[other->second] = h;
                waiting.erase(other);
            } else {
                waiting.emplace(a << 32 | b, h);
            }
        }
}

Surface remesh(const Surface& surface, const RemeshTarget& target) {
    Remesher remesher(surface, target);
    for (int i = 0; i < target.rounds; ++i) remesher.round();
    remesher.tidy();
    return remesher.result();
}

}  // namespace dermis::bust
