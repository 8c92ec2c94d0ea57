// Coverage by counting texels, charts and seams by union-find over edges, stretch from the first fundamental
// form.

#include "dermis/mesh/uv_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "dermis/mesh/stretch.h"
#include "dermis/mesh/topology.h"

namespace dermis {
namespace {

constexpr int64_t kSubTexels = 256;
constexpr size_t kMaxTiles = 100;  // counted; a layout of more is no atlas

using Fixed = std::array<int64_t, 2>;

// Twice the signed area of (a, b, p).
int64_t edge(Fixed a, Fixed b, Fixed p) {
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

// Texel centres exactly on an edge belong to one of its two triangles: the top-left rule.
bool owns_edge(Fixed a, Fixed b) {
    return (a[1] == b[1] && b[0] > a[0]) || b[1] < a[1];
}

class TexelCounter {
  public:
    explicit TexelCounter(int resolution)
        : resolution_(resolution), counts_(size_t(resolution) * resolution) {}

    /// Corners in units of the tile, origin top-left.
    void add(std::array<Vec2, 3> corners) {
        std::array<Fixed, 3> p;
        for (size_t k = 0; k < 3; ++k) {
            const double x = double(corners[k].x) * resolution_, y = double(corners[k].y) * resolution_;
            if (!(std::abs(x) < 1e6 && std::abs(y) < 1e6)) return;
            p[k] = {std::llround(x * kSubTexels), std::llround(y * kSubTexels)};
        }
        const int64_t area = edge(p[0], p[1], p[2]);
        if (area == 0) return;
        if (area < 0) std::swap(p[1], p[2]);
        const auto [x0, x1] = texel_range(p, 0);
        const auto [y0, y1] = texel_range(p, 1);
        for (int64_t y = y0; y <= y1; ++y)
            for (int64_t x = x0; x <= x1; ++x)
                if (covers(p, {x * kSubTexels + kSubTexels / 2, y * kSubTexels + kSubTexels / 2}))
                    if (uint8_t& count = counts_[size_t(y * resolution_ + x)]; count < 255) ++count;
    }

    [[nodiscard]] size_t at_least(int count) const {
        return size_t(std::ranges::count_if(counts_, [&](uint8_t c) { return c >= count; }));
    }

  private:
    [[nodiscard]] std::pair<int64_t, int64_t> texel_range(const std::array<Fixed, 3>& p, size_t axis) const {
        const auto [low, high] = std::minmax({p[0][axis], p[1][axis], p[2][axis]});
        return {std::max<int64_t>(0, low / kSubTexels - 1),
                std::min<int64_t>(resolution_ - 1, high / kSubTexels + 1)};
    }
    static bool covers(const std::array<Fixed, 3>& p, Fixed centre) {
        for (size_t k = 0; k < 3; ++k) {
            const Fixed a = p[k], b = p[(k + 1) % 3];
            const int64_t side = edge(a, b, centre);
            if (side < 0 || (side == 0 && !owns_edge(a, b))) return false;
        }
        return true;
    }

    int64_t resolution_;
    std::vector<uint8_t> counts_;
};

std::vector<uint32_t> triangles_of(const Mesh& mesh, std::optional<uint32_t> material) {
    std::vector<uint32_t> triangles;
    for (const Submesh& submesh : mesh.submeshes)
        if (!material || submesh.material == *material)
            for (uint32_t i = 0; i < submesh.index_count / 3; ++i)
                triangles.push_back(submesh.first_index / 3 + i);
    return triangles;
}

std::array<Vec2, 3> uvs_of(const Mesh& mesh, uint32_t triangle) {
    const uint32_t* i = &mesh.indices[3 * size_t{triangle}];
    return {mesh.uvs[i[0]], mesh.uvs[i[1]], mesh.uvs[i[2]]};
}

void count_texels(const Mesh& mesh, std::span<const uint32_t> triangles, int resolution, UvReport& report) {
    std::map<int, std::vector<uint32_t>> by_tile;
    for (const uint32_t t : triangles) {
        const auto uv = uvs_of(mesh, t);
        by_tile[udim_tile((uv[0] + uv[1] + uv[2]) * (1.0f / 3))].push_back(t);
    }
    by_tile.erase(0);
    size_t covered = 0, overlapped = 0;
    for (const auto& [tile, members] : by_tile) {
        report.tiles.push_back(tile);
        if (report.tiles.size() > kMaxTiles) continue;
        TexelCounter counter(resolution);
        const Vec2 corner = {float((tile - 1001) % 10), float(-((tile - 1001) / 10))};
        for (const uint32_t t : members) {
            const auto uv = uvs_of(mesh, t);
            counter.add({uv[0] - corner, uv[1] - corner, uv[2] - corner});
        }
        covered += counter.at_least(1);
        overlapped += counter.at_least(2);
    }
    const double texels = double(resolution) * resolution * double(std::min(by_tile.size(), kMaxTiles));
    report.coverage = texels > 0 ? double(covered) / texels : 0;
    report.overlap = covered > 0 ? double(overlapped) / double(covered) : 0;
}

// An edge of the position mesh with the UV vertices at its ends, the lower position first.
struct EdgeSide {
    uint32_t a, b;        // positions
    uint32_t uv_a, uv_b;  // welded position and UV
    uint32_t triangle;    // number within the list
};

std::vector<EdgeSide> edge_sides(const Mesh& mesh, std::span<const uint32_t> triangles,
                                 const Weld& positions) {
    std::vector<uint32_t> words;
    for (size_t i = 0; i < mesh.uvs.size(); ++i)
        for (const uint32_t word : {positions.ids[i], weld_key(mesh.uvs[i].x), weld_key(mesh.uvs[i].y)})
            words.push_back(word);
    const Weld uvs = weld_records(words, 3);
    std::vector<EdgeSide> sides;
    for (uint32_t n = 0; n < triangles.size(); ++n)
        for (uint32_t k = 0; k < 3; ++k) {
            uint32_t i = mesh.indices[3 * triangles[n] + k], j = mesh.indices[3 * triangles[n] + (k + 1) % 3];
            if (positions.ids[i] > positions.ids[j]) std::swap(i, j);
            sides.push_back({positions.ids[i], positions.ids[j], uvs.ids[i], uvs.ids[j], n});
        }
    std::ranges::sort(sides, [](const EdgeSide& x, const EdgeSide& y) {
        return std::tie(x.a, x.b, x.triangle) < std::tie(y.a, y.b, y.triangle);
    });
    return sides;
}

void find_charts(const Mesh& mesh, std::span<const uint32_t> triangles, UvReport& report) {
    const Weld positions = weld_positions(mesh.positions_mm);
    const std::vector<EdgeSide> sides = edge_sides(mesh, triangles, positions);
    DisjointSets charts(triangles.size());
    for (size_t i = 1; i < sides.size(); ++i) {
        const EdgeSide &x = sides[i - 1], &y = sides[i];
        if (x.a != y.a || x.b != y.b) continue;
        if (x.uv_a == y.uv_a && x.uv_b == y.uv_b)
            charts.join(x.triangle, y.triangle);
        else
            report.seam_length_mm +=
                length(mesh.positions_mm[positions.first[x.a]] - mesh.positions_mm[positions.first[x.b]]);
    }
    for (uint32_t n = 0; n < triangles.size(); ++n) report.charts += charts.find(n) == n;
}

struct Weighted {
    float value, weight;
};

Percentiles percentiles_of(std::vector<Weighted> samples) {
    std::ranges::sort(samples, {}, &Weighted::value);
    double total = 0;
    for (const Weighted& sample : samples) total += sample.weight;
    const auto at = [&](double share) {
        double sum = 0;
        for (const Weighted& sample : samples)
            if ((sum += sample.weight) >= share * total) return sample.value;
        return samples.empty() ? 0.0f : samples.back().value;
    };
    return {at(0.05), at(0.5), at(0.95)};
}

void measure_stretch(const Mesh& mesh, std::span<const uint32_t> triangles, UvReport& report) {
    const std::vector<UvMetric> metrics = triangle_uv_metrics(mesh);
    const std::vector<float> areas = triangle_areas_mm2(mesh);
    std::vector<Weighted> lengths, anisotropies;
    double area = 0, mirrored = 0, outside = 0;
    for (const uint32_t t : triangles) {
        const auto uv = uvs_of(mesh, t);
        area += areas[t];
        if (udim_tile((uv[0] + uv[1] + uv[2]) * (1.0f / 3)) == 0) outside += areas[t];
        if (metrics[t].mm_per_uv() == 0) {
            ++report.degenerate_triangles;
            continue;
        }
        // v points down: counter-clockwise on the surface is clockwise here.
        if (cross(uv[1] - uv[0], uv[2] - uv[0]) > 0) mirrored += areas[t];
        lengths.push_back({metrics[t].mm_per_uv() / 2048, areas[t]});
        anisotropies.push_back({metrics[t].anisotropy(), areas[t]});
    }
    report.area_mirrored = area > 0 ? mirrored / area : 0;
    report.area_outside = area > 0 ? outside / area : 0;
    report.mm_per_texel_2048 = percentiles_of(std::move(lengths));
    report.anisotropy = percentiles_of(std::move(anisotropies));
}

}  // namespace

int udim_tile(Vec2 uv) {
    // UDIM counts from the bottom-left: 1001 + column + 10 row.
    const float column = std::floor(uv.x), row = std::floor(1 - uv.y);
    if (!(column >= 0 && column < 10 && row >= 0 && row < 800)) return 0;
    return 1001 + int(column) + 10 * int(row);
}

UvReport analyze_uvs(const Mesh& mesh, std::optional<uint32_t> material, int resolution) {
    UvReport report;
    const std::vector<uint32_t> triangles = triangles_of(mesh, material);
    count_texels(mesh, triangles, resolution, report);
    find_charts(mesh, triangles, report);
    measure_stretch(mesh, triangles, report);
    return report;
}

}  // namespace dermis
