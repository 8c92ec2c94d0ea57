// Coverage by counting texels, charts and seams by union-find over edges, stretch from the first fundamental
// form.

#include "dermis/mesh/uv_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "dermis/mesh/topology.h"

namespace dermis::inline mesh {
namespace {

constexpr int64_t kSubTexels = 256;
constexpr size_t kMaxTiles = 100;  // layouts with more are not atlases

using Fixed = std::array<int64_t, 2>;

// Twice the signed area of (a, b, p).
int64_t edge(Fixed a, Fixed b, Fixed p) {
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

// Texel centres exactly on an edge belong to one of its two triangles: the top-left rule.
bool owns_edge(Fixed a, Fixed b) {
    return (a[1] == b[1] && b[0] > a[0]) || b[1] < a[1];
}

int64_t floor_divide(int64_t a, int64_t positive) {
    return a >= 0 ? a / positive : -((-a + positive - 1) / positive);
}

// Counts how many triangles cover each texel centre. A triangle costs a step a row, however large it is: only
// where its span begins and ends is noted, and one sweep adds up.
class TexelCounter {
  public:
    explicit TexelCounter(int resolution)
        : resolution_(resolution), changes_(size_t(resolution + 1) * size_t(resolution)) {}

    /// Corners in units of the tile, origin top-left.
    void add(std::array<Vec2, 3> corners) {
        std::array<Fixed, 3> p;
        for (size_t k = 0; k < 3; ++k) {
            const double x = double(corners[k].x) * double(resolution_),
                         y = double(corners[k].y) * double(resolution_);
            if (!(std::abs(x) < 1e6 && std::abs(y) < 1e6)) return;
            p[k] = {std::llround(x * kSubTexels), std::llround(y * kSubTexels)};
        }
        const int64_t area = edge(p[0], p[1], p[2]);
        if (area == 0) return;
        if (area < 0) std::swap(p[1], p[2]);
        const auto [low, high] = std::minmax({p[0][1], p[1][1], p[2][1]});
        const int64_t first = std::max<int64_t>(0, low / kSubTexels - 1),
                      last = std::min<int64_t>(resolution_ - 1, high / kSubTexels + 1);
        for (int64_t y = first; y <= last; ++y) add_row(p, y);
    }

    struct Covered {
        size_t once = 0, more = 0;  ///< texels under at least one triangle, and under more
    };
    [[nodiscard]] Covered count() const {
        Covered covered;
        for (int64_t y = 0; y < resolution_; ++y) {
            int64_t depth = 0;
            for (int64_t x = 0; x < resolution_; ++x) {
                depth += changes_[size_t(y * (resolution_ + 1) + x)];
                covered.once += depth >= 1;
                covered.more += depth >= 2;
            }
        }
        return covered;
    }

  private:
    // The texels of a row whose centres are inside of all three edges: each is linear in x.
    void add_row(const std::array<Fixed, 3>& p, int64_t y) {
        int64_t first = 0, last = resolution_ - 1;
        for (size_t k = 0; k < 3; ++k) {
            const Fixed a = p[k], b = p[(k + 1) % 3];
            const int64_t side = edge(a, b, {kSubTexels / 2, y * kSubTexels + kSubTexels / 2});
            const int64_t step = (a[1] - b[1]) * kSubTexels;  // from texel to texel
            const int64_t needed = (owns_edge(a, b) ? 0 : 1) - side;
            if (step > 0)
                first = std::max(first, -floor_divide(-needed, step));
            else if (step < 0)
                last = std::min(last, floor_divide(-needed, -step));
            else if (needed > 0)
                return;
        }
        if (first > last) return;
        ++changes_[size_t(y * (resolution_ + 1) + first)];
        --changes_[size_t(y * (resolution_ + 1) + last + 1)];
    }

    int64_t resolution_;
    std::vector<int32_t> changes_;  // of the depth, before each texel
};

// Positions, UVs and triangles of one material alone, so that a report on each of hundreds does not cost the
// whole mesh each time.
Mesh part_of(const Mesh& mesh, uint32_t material) {
    std::vector<uint32_t> indices;
    for (const Submesh& submesh : mesh.submeshes) {
        const auto first = mesh.indices.begin() + submesh.first_index;
        if (submesh.material == material) indices.insert(indices.end(), first, first + submesh.index_count);
    }
    std::vector<uint32_t> vertices = indices;
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    Mesh part;
    for (const uint32_t vertex : vertices) {
        part.positions_mm.push_back(mesh.positions_mm[vertex]);
        part.uvs.push_back(mesh.uvs[vertex]);
    }
    for (const uint32_t index : indices)
        part.indices.push_back(uint32_t(std::ranges::lower_bound(vertices, index) - vertices.begin()));
    return part;
}

std::array<Vec2, 3> uvs_of(const Mesh& mesh, uint32_t triangle) {
    const uint32_t* i = &mesh.indices[3 * size_t(triangle)];
    return {mesh.uvs[i[0]], mesh.uvs[i[1]], mesh.uvs[i[2]]};
}

// Halved while the triangles cross more rows than take a few seconds.
int affordable_resolution(const Mesh& mesh, int resolution) {
    constexpr double kMaxRows = 2e8;
    constexpr int kCoarsest = 64;
    double tiles = 0;  // heights of all triangles
    for (uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        const auto uv = uvs_of(mesh, t);
        const double height =
            double(std::max({uv[0].y, uv[1].y, uv[2].y})) - double(std::min({uv[0].y, uv[1].y, uv[2].y}));
        tiles += std::min(height, 1.0);
    }
    while (resolution > kCoarsest && tiles * resolution > kMaxRows) resolution /= 2;
    return resolution;
}

void count_texels(const Mesh& mesh, int wanted_resolution, UvReport& report) {
    std::map<int, std::vector<uint32_t>> by_tile;
    for (uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        const auto uv = uvs_of(mesh, t);
        by_tile[udim_tile((uv[0] + uv[1] + uv[2]) * (1.0f / 3))].push_back(t);
    }
    by_tile.erase(0);
    const int resolution = affordable_resolution(mesh, wanted_resolution);
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
        const TexelCounter::Covered texels = counter.count();
        covered += texels.once;
        overlapped += texels.more;
    }
    const double texels = double(resolution) * resolution * double(std::min(by_tile.size(), kMaxTiles));
    report.coverage = texels > 0 ? double(covered) / texels : 0;
    report.overlap = covered > 0 ? double(overlapped) / double(covered) : 0;
}

// An edge of the position mesh with the UV vertices at its ends, the lower position first.
struct EdgeSide {
    uint32_t a, b;        // positions
    uint32_t uv_a, uv_b;  // welded position and UV
    uint32_t triangle;
};

std::vector<EdgeSide> edge_sides(const Mesh& mesh, const Weld& positions) {
    std::vector<uint32_t> words;
    for (size_t i = 0; i < mesh.uvs.size(); ++i)
        for (const uint32_t word : {positions.ids[i], weld_key(mesh.uvs[i].x), weld_key(mesh.uvs[i].y)})
            words.push_back(word);
    const Weld uvs = weld_records(words, 3);
    std::vector<EdgeSide> sides;
    for (uint32_t n = 0; n < mesh.triangle_count(); ++n)
        for (uint32_t k = 0; k < 3; ++k) {
            uint32_t i = mesh.indices[3 * n + k], j = mesh.indices[3 * n + (k + 1) % 3];
            if (positions.ids[i] > positions.ids[j]) std::swap(i, j);
            sides.push_back({positions.ids[i], positions.ids[j], uvs.ids[i], uvs.ids[j], n});
        }
    std::ranges::sort(sides, [](const EdgeSide& x, const EdgeSide& y) {
        return std::tie(x.a, x.b, x.triangle) < std::tie(y.a, y.b, y.triangle);
    });
    return sides;
}

void find_charts(const Mesh& mesh, UvReport& report) {
    const Weld positions = weld_positions(mesh.positions_mm);
    const std::vector<EdgeSide> sides = edge_sides(mesh, positions);
    DisjointSets charts(mesh.triangle_count());
    for (size_t i = 1; i < sides.size(); ++i) {
        const EdgeSide &x = sides[i - 1], &y = sides[i];
        if (x.a != y.a || x.b != y.b) continue;
        if (x.uv_a == y.uv_a && x.uv_b == y.uv_b)
            charts.join(x.triangle, y.triangle);
        else
            report.seam_length_mm +=
                length(mesh.positions_mm[positions.first[x.a]] - mesh.positions_mm[positions.first[x.b]]);
    }
    for (uint32_t n = 0; n < mesh.triangle_count(); ++n) report.charts += charts.find(n) == n;
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

void measure_stretch(const Mesh& mesh, UvReport& report) {
    const std::vector<UvMetric> metrics = triangle_uv_metrics(mesh);
    const std::vector<float> areas = triangle_areas_mm2(mesh);
    std::vector<Weighted> lengths, anisotropies;
    double area = 0, mirrored = 0, outside = 0;
    for (uint32_t t = 0; t < mesh.triangle_count(); ++t) {
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
    if (material) return analyze_uvs(part_of(mesh, *material), std::nullopt, resolution);
    UvReport report;
    count_texels(mesh, resolution, report);
    find_charts(mesh, report);
    measure_stretch(mesh, report);
    return report;
}

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
