// Marching tetrahedra (Doi & Koide 1991) on the six Kuhn tetrahedra of every cube.

#include <cstdint>
#include <unordered_map>

#include "dermis/base/parallel.h"
#include "subjects/bust/surface.h"

namespace dermis::bust {
namespace {

constexpr int kBlock = 4;  // cubes along a block's edge
constexpr int kCorners = kBlock + 1;

// Corners are bit masks of (x, y, z); each tetrahedron goes from corner 0 to corner 7 along one order of the
// axes, and the parity of this order is its orientation.
struct Tetrahedron {
    int corner[4];
    bool flipped;
};
constexpr Tetrahedron kKuhn[6] = {{{0, 1, 3, 7}, false}, {{0, 1, 5, 7}, true},  {{0, 2, 3, 7}, true},
                                  {{0, 2, 6, 7}, false}, {{0, 4, 5, 7}, false}, {{0, 4, 6, 7}, true}};

struct Grid {
    Box box;
    double cell_mm;
    int blocks[3];
    int nodes[3];

    [[nodiscard]] Point at(int x, int y, int z) const {
        return box.low + Point{x * cell_mm, y * cell_mm, z * cell_mm};
    }
    [[nodiscard]] uint64_t node(int x, int y, int z) const {
        return (uint64_t(z) * nodes[1] + y) * nodes[0] + x;
    }
};

struct BlockValues {
    int x, y, z;  // first node
    std::array<double, kCorners * kCorners * kCorners> distance;
};

std::vector<BlockValues> sample(const Grid& grid, const std::function<double(Point)>& distance) {
    const size_t count = size_t(grid.blocks[0]) * grid.blocks[1] * grid.blocks[2];
    const double reach = 0.5 * kBlock * grid.cell_mm * std::sqrt(3.0) * 2;
    std::vector<BlockValues> all(count);
    std::vector<char> near(count, 0);
    parallel_for(count, 32, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            BlockValues& b = all[i];
            b.x = int(i % grid.blocks[0]) * kBlock;
            b.y = int(i / grid.blocks[0] % grid.blocks[1]) * kBlock;
            b.z = int(i / grid.blocks[0] / grid.blocks[1]) * kBlock;
            const double h = 0.5 * kBlock * grid.cell_mm;
            if (std::abs(distance(grid.at(b.x, b.y, b.z) + Point{h, h, h})) > reach) continue;
            near[i] = 1;
            for (int k = 0; k < kCorners * kCorners * kCorners; ++k)
                b.distance[k] = distance(grid.at(b.x + k % kCorners, b.y + k / kCorners % kCorners,
                                                 b.z + k / kCorners / kCorners));
        }
    });
    std::vector<BlockValues> kept;
    for (size_t i = 0; i < count; ++i)
        if (near[i]) kept.push_back(all[i]);
    return kept;
}

class Builder {
  public:
    explicit Builder(const Grid& grid) : grid_(grid) {}

    void add_block(const BlockValues& b) {
        for (int z = 0; z < kBlock; ++z)
            for (int y = 0; y < kBlock; ++y)
                for (int x = 0; x < kBlock; ++x) {
                    int node[8][3];
                    double d[8];
                    int inside = 0;
                    for (int c = 0; c < 8; ++c) {
                        const int cx = x + (c & 1), cy = y + (c >> 1 & 1), cz = z + (c >> 2 & 1);
                        node[c][0] = b.x + cx, node[c][1] = b.y + cy, node[c][2] = b.z + cz;
                        d[c] = b.distance[(cz * kCorners + cy) * kCorners + cx];
                        inside += d[c] < 0;
                    }
                    if (inside == 0 || inside == 8) continue;
                    for (const Tetrahedron& t : kKuhn) add_tetrahedron(t, node, d);
                }
    }
    Surface surface;

  private:
    void add_tetrahedron(const Tetrahedron& t, const int (&node)[8][3], const double (&d)[8]) {
        int in[4], out[4], ins = 0, outs = 0;
        int order[4];
        for (const int c : t.corner) (d[c] < 0 ? in[ins++] : out[outs++]) = c;
        if (ins == 0 || outs == 0) return;
        int k = 0;
        for (int i = 0; i < ins; ++i) order[k++] = in[i];
        for (int i = 0; i < outs; ++i) order[k++] = out[i];
        // The parity of (inside..., outside...) relative to the tetrahedron's order is the orientation of the
        // cut.
        bool odd = t.flipped;
        for (int i = 0; i < 4; ++i)
            for (int j = i + 1; j < 4; ++j) odd ^= place(t, order[i]) > place(t, order[j]);
        const auto cut = [&](int a, int b) { return vertex(node[a], d[a], node[b], d[b]); };
        const auto face = [&](int a, int b, int c) {
            if (odd) std::swap(b, c);
            if (a != b && b != c && a != c) surface.triangles.push_back({a, b, c});
        };
        if (ins == 1) {
            face(cut(in[0], out[0]), cut(in[0], out[1]), cut(in[0], out[2]));
        } else if (ins == 3) {
            face(cut(in[0], out[0]), cut(in[1], out[0]), cut(in[2], out[0]));
        } else {
            const int a = cut(in[0], out[0]), b = cut(in[0], out[1]), c = cut(in[1], out[1]),
                      e = cut(in[1], out[0]);
            face(a, b, c);
            face(a, c, e);
        }
    }
    static int place(const Tetrahedron& t, int corner) {
        return int(std::find(t.corner, t.corner + 4, corner) - t.corner);
    }
    int vertex(const int (&a)[3], double da, const int (&b)[3], double db) {
        // Edges of one cube's tetrahedra never span more than one step, so the lower node and the direction
        // identify an edge.
        const uint64_t na = grid_.node(a[0], a[1], a[2]), nb = grid_.node(b[0], b[1], b[2]);
        const int* low = na < nb ? a : b;
        const int* high = na < nb ? b : a;
        const int direction = (high[0] - low[0]) + 2 * (high[1] - low[1]) + 4 * (high[2] - low[2]);
        const auto [entry, fresh] =
            vertices_.try_emplace(std::min(na, nb) * 8 + uint64_t(direction), int(surface.points.size()));
        if (fresh) {
            // Kept off the nodes: two cuts at one node would make a triangle without area.
            const double t = std::clamp(da / (da - db), 0.05, 0.95);
            surface.points.push_back(mix(grid_.at(a[0], a[1], a[2]), grid_.at(b[0], b[1], b[2]), t));
        }
        return entry->second;
    }

    const Grid& grid_;
    std::unordered_map<uint64_t, int> vertices_;
};

}  // namespace

Surface extract_surface(const std::function<double(Point)>& distance, Box box, double cell_mm) {
    Grid grid = {box, cell_mm, {}, {}};
    const double size[3] = {box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z};
    for (int k = 0; k < 3; ++k) {
        grid.blocks[k] = int(std::ceil(size[k] / (cell_mm * kBlock)));
        grid.nodes[k] = grid.blocks[k] * kBlock + 1;
    }
    Builder builder(grid);
    for (const BlockValues& block : sample(grid, distance)) builder.add_block(block);
    return std::move(builder.surface);
}

}  // namespace dermis::bust
