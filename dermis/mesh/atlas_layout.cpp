// Step 1: triangles of one material and one UDIM tile are a unit. A material with triangles across tile
// borders is a unit as a whole.
//
// Step 2: a unit that shares texels with itself is split into charts. Each chart goes into the first layer
// whose texels are free. Other units become a layer of their own, or join a layer of the same tile. Charts
// that share texels with themselves, and triangles without UVs, are unwrapped: each new chart is a layer.
//
// Step 3: layers are scaled to their area on the surface and packed.

#include "dermis/mesh/atlas_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

#include "dermis/mesh/pack_charts.h"
#include "dermis/mesh/topology.h"
#include "dermis/mesh/unwrap.h"
#include "dermis/mesh/uv_report.h"
#include "dermis/mesh/uv_texels.h"

namespace dermis::inline mesh {
namespace {

constexpr int kTexels = 512;             // a side of a tile, to find overlap
constexpr float kTileTolerance = 1e-3f;  // exporters round the borders of a tile

struct Triangle {
    uint32_t part = 0, corners = 0;  // corners: first index in the part's mesh
    std::array<Vec2, 3> uvs;
    UvMetric metric;
    float area_mm2 = 0;
};

// Part of a UV plane, to count texels in.
struct Frame {
    Vec2 origin;
    float side = 1;
    friend auto operator<=>(const Frame& a, const Frame& b) {
        return std::tie(a.origin.x, a.origin.y, a.side) <=> std::tie(b.origin.x, b.origin.y, b.side);
    }
};

struct Box {
    Vec2 low = {std::numeric_limits<float>::max(), std::numeric_limits<float>::max()};
    Vec2 high = {std::numeric_limits<float>::lowest(), std::numeric_limits<float>::lowest()};

    void add(Vec2 p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    [[nodiscard]] bool within(Vec2 corner, float side, float tolerance) const {
        return low.x >= corner.x - tolerance && low.y >= corner.y - tolerance &&
               high.x <= corner.x + side + tolerance && high.y <= corner.y + side + tolerance;
    }
};

using Members = std::vector<uint32_t>;  // triangles, by number over all parts

struct Unit {
    Frame frame;
    bool is_tile = true;
    Members members;
};

struct Layer {
    Frame frame;
    bool is_tile = true;
    Members members;
    std::vector<bool> taken = std::vector<bool>(size_t(kTexels) * kTexels, false);
    bool is_unwrapped = false;  // joined by nothing else
};

Box box_of(std::span<const Triangle> triangles, const Members& members) {
    Box box;
    for (const uint32_t t : members)
        for (const Vec2 uv : triangles[t].uvs) box.add(uv);
    return box;
}

std::vector<Triangle> triangles_of(std::span<const AtlasPart> parts) {
    std::vector<Triangle> triangles;
    for (uint32_t part = 0; part < parts.size(); ++part) {
        const Mesh& mesh = *parts[part].mesh;
        const bool has_uvs = mesh.uvs.size() == mesh.positions_mm.size();
        const std::vector<UvMetric> metrics =
            has_uvs ? triangle_uv_metrics(mesh) : std::vector<UvMetric>(mesh.triangle_count());
        const std::vector<float> areas = triangle_areas_mm2(mesh);
        for (const uint32_t number : parts[part].triangles) {
            Triangle triangle{
                .part = part, .corners = 3 * number, .metric = metrics[number], .area_mm2 = areas[number]};
            if (has_uvs)
                for (size_t k = 0; k < 3; ++k)
                    triangle.uvs[k] = mesh.uvs[mesh.indices[3 * size_t(number) + k]];
            triangles.push_back(triangle);
        }
    }
    return triangles;
}

std::vector<uint32_t> material_of_triangles(const Mesh& mesh) {
    std::vector<uint32_t> materials(mesh.triangle_count(), 0);
    for (const Submesh& submesh : mesh.submeshes)
        std::fill_n(materials.begin() + submesh.first_index / 3, submesh.index_count / 3, submesh.material);
    return materials;
}

Frame tile_of(const Triangle& triangle) {
    const Vec2 middle = (triangle.uvs[0] + triangle.uvs[1] + triangle.uvs[2]) * (1.0f / 3);
    return {.origin = {std::floor(middle.x), std::floor(middle.y)}};
}

bool crosses_tiles(const Triangle& triangle) {
    const Frame tile = tile_of(triangle);
    return !std::ranges::all_of(triangle.uvs, [&](Vec2 uv) {
        Box box;
        box.add(uv);
        return box.within(tile.origin, 1, kTileTolerance);
    });
}

// Step 1.
std::vector<Unit> find_units(std::span<const AtlasPart> parts, std::span<const Triangle> triangles) {
    using Key = std::pair<uint32_t, uint32_t>;  // part, material
    std::map<Key, Members> by_material;
    std::vector<std::vector<uint32_t>> materials;
    for (const AtlasPart& part : parts) materials.push_back(material_of_triangles(*part.mesh));
    for (uint32_t t = 0; t < triangles.size(); ++t)
        by_material[{triangles[t].part, materials[triangles[t].part][triangles[t].corners / 3]}].push_back(t);
    std::vector<Unit> units;
    for (const auto& [key, members] : by_material) {
        if (std::ranges::any_of(members, [&](uint32_t t) { return crosses_tiles(triangles[t]); })) {
            const Box box = box_of(triangles, members);
            units.push_back({{box.low, std::max({box.high.x - box.low.x, box.high.y - box.low.y, 1e-6f})},
                             false,
                             members});
            continue;
        }
        std::map<Frame, Members> by_tile;
        for (const uint32_t t : members) by_tile[tile_of(triangles[t])].push_back(t);
        for (auto& [tile, of_tile] : by_tile) units.push_back({tile, true, std::move(of_tile)});
    }
    return units;
}

struct Texels {
    std::vector<uint32_t> once;
    size_t again = 0;  // under a further triangle
};

Texels texels_of(std::span<const Triangle> triangles, const Members& members, const Frame& frame) {
    std::vector<bool> own(size_t(kTexels) * kTexels, false);
    Texels texels;
    for (const uint32_t t : members) {
        std::array<std::array<double, 2>, 3> corners;
        for (size_t k = 0; k < 3; ++k) {
            const Vec2 at = (triangles[t].uvs[k] - frame.origin) * (kTexels / frame.side);
            corners[k] = {double(at.x), double(at.y)};
        }
        visit_texels_of(corners, {kTexels, kTexels}, [&](int x, int y, double, double) {
            const auto texel = uint32_t(y * kTexels + x);
            if (own[texel])
                ++texels.again;
            else
                own[texel] = true, texels.once.push_back(texel);
        });
    }
    return texels;
}

bool is_free(const Layer& layer, const Texels& texels) {
    const auto allowed = size_t(kOverlapOfLayer * double(texels.once.size()));
    size_t shared = 0;
    return std::ranges::none_of(texels.once,
                                [&](uint32_t texel) { return layer.taken[texel] && ++shared > allowed; });
}

// Into the first layer from `first` on that has the texels free, else into a new one.
void deal(std::vector<Layer>& layers, size_t first, const Unit& unit, const Members& members,
          const Texels& texels) {
    const auto fits = [&](const Layer& layer) {
        return !layer.is_unwrapped && layer.is_tile == unit.is_tile && !(layer.frame < unit.frame) &&
               !(unit.frame < layer.frame) && is_free(layer, texels);
    };
    auto layer = std::find_if(layers.begin() + std::ptrdiff_t(first), layers.end(), fits);
    if (layer == layers.end()) layer = layers.insert(layers.end(), {unit.frame, unit.is_tile, {}});
    layer->members.insert(layer->members.end(), members.begin(), members.end());
    for (const uint32_t texel : texels.once) layer->taken[texel] = true;
}

bool is_mirrored(const Triangle& triangle) {
    return cross(triangle.uvs[1] - triangle.uvs[0], triangle.uvs[2] - triangle.uvs[0]) > 0;
}

// The pieces that hang together in UV without a fold, the largest on the surface first.
std::vector<Members> find_charts(std::span<const AtlasPart> parts, std::span<const Triangle> triangles,
                                 const Members& members) {
    const Mesh& mesh = *parts[triangles[members[0]].part].mesh;
    std::vector<uint32_t> words;
    for (const uint32_t t : members)
        for (size_t k = 0; k < 3; ++k) {
            const Vec3 p = mesh.positions_mm[mesh.indices[triangles[t].corners + k]];
            const Vec2 uv = triangles[t].uvs[k];
            for (const float value : {p.x, p.y, p.z, uv.x, uv.y}) words.push_back(weld_key(value));
        }
    const Weld places = weld_records(words, 5);
    struct Edge {
        uint32_t a, b, triangle;  // triangle: of `members`
    };
    std::vector<Edge> edges;
    for (uint32_t i = 0; i < members.size(); ++i)
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t a = places.ids[3 * i + k], b = places.ids[3 * i + (k + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), i});
        }
    std::ranges::sort(edges, {}, [](const Edge& e) { return std::tuple(e.a, e.b, e.triangle); });
    DisjointSets sets(members.size());
    for (size_t i = 1; i < edges.size(); ++i) {
        const Edge &x = edges[i - 1], &y = edges[i];
        if (x.a == y.a && x.b == y.b &&
            is_mirrored(triangles[members[x.triangle]]) == is_mirrored(triangles[members[y.triangle]]))
            sets.join(x.triangle, y.triangle);
    }
    std::map<uint32_t, Members> by_leader;
    for (uint32_t i = 0; i < members.size(); ++i) by_leader[sets.find(i)].push_back(members[i]);
    std::vector<Members> charts;
    for (auto& [leader, chart] : by_leader) charts.push_back(std::move(chart));
    const auto area_mm2 = [&](const Members& chart) {
        double sum = 0;
        for (const uint32_t t : chart) sum += double(triangles[t].area_mm2);
        return sum;
    };
    std::ranges::stable_sort(charts, std::greater<>(), area_mm2);
    return charts;
}

bool shares_none(const Texels& texels) {
    return double(texels.again) <= kOverlapOfLayer * double(texels.once.size());
}

// Its triangles have an area on the surface, but none in UV.
bool lacks_uvs(std::span<const Triangle> triangles, const Members& members) {
    double area_mm2 = 0;
    for (const uint32_t t : members) {
        if (triangles[t].metric.e_mm2 > 0) return false;
        area_mm2 += double(triangles[t].area_mm2);
    }
    return area_mm2 > 0;
}

// Gives triangles of one part new UVs, a layer for each chart.
void unwrap_into(std::vector<Layer>& layers, const Mesh& mesh, std::span<Triangle> triangles,
                 const Members& members) {
    if (members.empty()) return;
    std::vector<uint32_t> numbers;
    for (const uint32_t t : members) numbers.push_back(triangles[t].corners / 3);
    const Unwrapping unwrapping = unwrap(mesh, numbers);
    std::vector<Members> charts(unwrapping.charts);
    for (size_t i = 0; i < members.size(); ++i) {
        Triangle& triangle = triangles[members[i]];
        triangle.uvs = unwrapping.corners_mm[i];
        triangle.metric = {1, 0, 1};  // in mm
        charts[unwrapping.chart[i]].push_back(members[i]);
    }
    for (Members& chart : charts) {
        if (chart.empty()) continue;
        const Box box = box_of(triangles, chart);
        const Frame frame{box.low, std::max({box.high.x - box.low.x, box.high.y - box.low.y, 1e-6f})};
        layers.push_back({frame, false, std::move(chart), {}, true});
    }
}

// Step 2.
std::vector<Layer> find_layers(std::span<const AtlasPart> parts, std::span<Triangle> triangles) {
    std::vector<Layer> layers;
    std::vector<Members> without_layout(parts.size());
    for (const Unit& unit : find_units(parts, triangles)) {
        Members& left = without_layout[triangles[unit.members[0]].part];
        if (lacks_uvs(triangles, unit.members)) {
            left.insert(left.end(), unit.members.begin(), unit.members.end());
            continue;
        }
        const Texels texels = texels_of(triangles, unit.members, unit.frame);
        if (shares_none(texels)) {
            deal(layers, 0, unit, unit.members, texels);
            continue;
        }
        const size_t first = layers.size();
        for (const Members& chart : find_charts(parts, triangles, unit.members)) {
            const Texels of_chart = texels_of(triangles, chart, unit.frame);
            if (lacks_uvs(triangles, chart) || !shares_none(of_chart))
                left.insert(left.end(), chart.begin(), chart.end());
            else
                deal(layers, first, unit, chart, of_chart);
        }
    }
    for (size_t part = 0; part < parts.size(); ++part)
        unwrap_into(layers, *parts[part].mesh, triangles, without_layout[part]);
    return layers;
}

// A layer's millimetres for a step of 1 in u and v: of equal area, and stretched as its triangles are on
// average.
Vec2 scale_mm(std::span<const Triangle> triangles, const Members& members) {
    double area_mm2 = 0, area_uv = 0, e = 0, g = 0;
    for (const uint32_t t : members) {
        const Triangle& triangle = triangles[t];
        const double uv =
            std::abs(double(cross(triangle.uvs[1] - triangle.uvs[0], triangle.uvs[2] - triangle.uvs[0]))) / 2;
        if (!(uv > 0) || triangle.metric.e_mm2 == 0) continue;
        area_uv += uv, area_mm2 += double(triangle.area_mm2);
        e += double(triangle.area_mm2) * std::sqrt(double(triangle.metric.e_mm2));
        g += double(triangle.area_mm2) * std::sqrt(double(triangle.metric.g_mm2));
    }
    if (!(area_uv > 0) || !(area_mm2 > 0)) return {1e-3f, 1e-3f};
    const double mean = std::sqrt(area_mm2 / area_uv);
    const double stretch = e > 0 && g > 0 ? std::clamp(std::sqrt(e / g), 0.1, 10.0) : 1;
    return {float(mean * stretch), float(mean / stretch)};
}

// Less between many layers, so that gaps do not take most of the atlas.
float gap_between(size_t count) {
    return std::clamp(0.12f / std::sqrt(float(count)), 1.0f / 256, 1.0f / 32);
}

// Step 3.
AtlasLayout pack(std::span<const AtlasPart> parts, std::span<const Triangle> triangles,
                 std::span<const Layer> layers) {
    std::vector<std::vector<std::array<Vec2, 3>>> charts;
    for (const Layer& layer : layers) {
        const Vec2 scale = scale_mm(triangles, layer.members);
        std::vector<std::array<Vec2, 3>>& chart = charts.emplace_back();
        for (const uint32_t t : layer.members) {
            chart.push_back(triangles[t].uvs);
            for (Vec2& uv : chart.back()) uv = {uv.x * scale.x, uv.y * scale.y};
        }
    }
    const std::vector<PackedChart> packed = pack_charts(charts, gap_between(layers.size()));
    AtlasLayout layout{.parts = {}, .layers = uint32_t(layers.size())};
    for (const AtlasPart& part : parts) layout.parts.emplace_back(part.triangles.size());
    std::vector<uint32_t> first(parts.size(), 0);
    for (size_t part = 1; part < parts.size(); ++part)
        first[part] = first[part - 1] + uint32_t(parts[part - 1].triangles.size());
    for (uint32_t i = 0; i < layers.size(); ++i)
        for (size_t k = 0; k < layers[i].members.size(); ++k) {
            const uint32_t t = layers[i].members[k], part = triangles[t].part;
            AtlasLayout::Corners& corners = layout.parts[part][t - first[part]];
            corners.layer = i;
            for (size_t c = 0; c < 3; ++c) corners.uvs[c] = packed[i].at(charts[i][k][c]);
        }
    return layout;
}

}  // namespace

AtlasLayout lay_out_atlas(std::span<const AtlasPart> parts) {
    std::vector<Triangle> triangles = triangles_of(parts);
    const std::vector<Layer> layers = find_layers(parts, triangles);
    const bool is_one_tile =
        layers.size() <= 1 && std::ranges::all_of(layers, [&](const Layer& layer) {
            return !layer.is_unwrapped && box_of(triangles, layer.members).within({0, 0}, 1, kTileTolerance);
        });
    if (is_one_tile) return {.is_as_it_was = true, .parts = {}};
    return pack(parts, triangles, layers);
}

}  // namespace dermis::inline mesh
