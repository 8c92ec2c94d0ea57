// Edges of the welded mesh are paired. Where both sides have the same UVs their triangles belong to one
// chart; where they differ there is a seam, and each side's gutter is mapped to the other: through the plane
// of the one triangle, turned about the edge into the plane of the other, into that one's UVs.

#include "dermis/mesh/uv_seams.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "dermis/mesh/topology.h"

namespace dermis::inline mesh {
namespace {

constexpr uint32_t kNone = ~0u;

// One triangle's side of an edge; uv[0], uv[1] at the edge's ends (the lower position first), uv[2] opposite.
struct Side {
    uint32_t a, b, triangle;
    Vec2 uv[3];  // in texels
    float along_mm, opposite_along_mm, opposite_height_mm;
};

struct Atlas {
    std::vector<Side> sides;
    std::vector<uint32_t> partner;  // of every side, or kNone
    std::vector<uint32_t> chart;    // of every triangle, numbered over all parts
};

bool inside(Vec2 uv) {
    return uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1;
}

Side make_side(const Mesh& mesh, uint32_t i, uint32_t j, uint32_t k, float size) {
    const Vec3 edge = mesh.positions_mm[j] - mesh.positions_mm[i];
    const Vec3 across = mesh.positions_mm[k] - mesh.positions_mm[i];
    const float along_mm = length(edge);
    const float s = along_mm > 0 ? dot(across, edge) / along_mm : 0;
    return {.a = 0,
            .b = 0,
            .triangle = 0,
            .uv = {mesh.uvs[i] * size, mesh.uvs[j] * size, mesh.uvs[k] * size},
            .along_mm = along_mm,
            .opposite_along_mm = s,
            .opposite_height_mm = std::sqrt(std::max(dot(across, across) - s * s, 0.0f))};
}

// Sides of one part, sorted by edge; triangles are numbered from `first_triangle`.
void collect_sides(const AtlasPart& part, float size, uint32_t first_triangle, uint32_t first_position,
                   const Weld& positions, std::vector<Side>& sides) {
    const Mesh& mesh = *part.mesh;
    for (uint32_t n = 0; n < part.triangles.size(); ++n) {
        const uint32_t* corner = &mesh.indices[3 * size_t(part.triangles[n])];
        if (!inside(mesh.uvs[corner[0]]) || !inside(mesh.uvs[corner[1]]) || !inside(mesh.uvs[corner[2]]))
            continue;
        for (uint32_t k = 0; k < 3; ++k) {
            uint32_t i = corner[k], j = corner[(k + 1) % 3];
            if (positions.ids[i] > positions.ids[j]) std::swap(i, j);
            Side side = make_side(mesh, i, j, corner[(k + 2) % 3], size);
            side.a = first_position + positions.ids[i], side.b = first_position + positions.ids[j];
            side.triangle = first_triangle + n;
            sides.push_back(side);
        }
    }
}

Atlas find_charts(std::span<const AtlasPart> parts, float size) {
    Atlas atlas;
    uint32_t triangles = 0, positions = 0;
    for (const AtlasPart& part : parts) {
        const Weld weld = weld_positions(part.mesh->positions_mm);
        collect_sides(part, size, triangles, positions, weld, atlas.sides);
        triangles += uint32_t(part.triangles.size()), positions += weld.count();
    }
    std::ranges::sort(atlas.sides, [](const Side& x, const Side& y) {
        return std::tie(x.a, x.b, x.triangle) < std::tie(y.a, y.b, y.triangle);
    });
    atlas.partner.assign(atlas.sides.size(), kNone);
    DisjointSets sets(triangles);
    for (uint32_t i = 1; i < atlas.sides.size(); ++i) {
        const Side &x = atlas.sides[i - 1], &y = atlas.sides[i];
        if (x.a != y.a || x.b != y.b || atlas.partner[i - 1] != kNone) continue;
        atlas.partner[i - 1] = i, atlas.partner[i] = i - 1;
        if (x.uv[0] == y.uv[0] && x.uv[1] == y.uv[1]) sets.join(x.triangle, y.triangle);
    }
    std::vector<uint32_t> number(triangles, 0);
    uint32_t charts = 0;
    for (uint32_t t = 0; t < triangles; ++t) {
        const uint32_t leader = sets.find(t);
        if (number[leader] == 0) number[leader] = 1 + charts++ % 255;
        atlas.chart.push_back(number[leader]);
    }
    return atlas;
}

// Texels whose centre lies in the box of some points, grown by `margin`.
template <class Visit>
void visit_texels(std::span<const Vec2> points, float margin, int size, const Visit& visit) {
    Vec2 low = points[0], high = points[0];
    for (const Vec2 p : points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const auto first = [&](float x) { return std::max(0, int(std::floor(x - margin - 0.5f))); };
    const auto last = [&](float x) { return std::min(size - 1, int(std::ceil(x + margin - 0.5f))); };
    for (int y = first(low.y); y <= last(high.y); ++y)
        for (int x = first(low.x); x <= last(high.x); ++x)
            visit(size_t(y) * size_t(size) + size_t(x), Vec2{float(x) + 0.5f, float(y) + 0.5f});
}

void fill_charts(const Atlas& atlas, SeamMap& map) {
    // Every triangle has three sides; any one of them names its corners.
    std::vector<bool> filled(atlas.chart.size(), false);
    for (const Side& side : atlas.sides) {
        if (filled[side.triangle]) continue;
        filled[side.triangle] = true;
        Vec2 a = side.uv[0], b = side.uv[1], c = side.uv[2];
        const float area = cross(b - a, c - a);
        if (area == 0) continue;
        if (area < 0) std::swap(b, c);
        visit_texels(side.uv, 0, map.size, [&](size_t texel, Vec2 p) {
            if (cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0)
                map.chart[texel] = uint8_t(atlas.chart[side.triangle]);
        });
    }
}

// UV as a + s * along + h * height, s and h in mm: s along the edge, h into the triangle.
struct EdgeFrame {
    Vec2 origin, along, height;
    float determinant = 0;

    explicit EdgeFrame(const Side& side) : origin(side.uv[0]) {
        if (!(side.along_mm > 0) || !(side.opposite_height_mm > 0)) return;
        along = (side.uv[1] - side.uv[0]) * (1 / side.along_mm);
        height = (side.uv[2] - side.uv[0] - along * side.opposite_along_mm) * (1 / side.opposite_height_mm);
        determinant = cross(along, height);
    }
    [[nodiscard]] Vec2 to_mm(Vec2 p) const {
        const Vec2 d = p - origin;
        return {cross(d, height) / determinant, cross(along, d) / determinant};
    }
    [[nodiscard]] Vec2 to_uv(Vec2 mm) const { return origin + along * mm.x + height * mm.y; }
};

float distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
    const Vec2 d = b - a;
    const float l2 = dot(d, d);
    const float t = l2 > 0 ? std::clamp(dot(p - a, d) / l2, 0.0f, 1.0f) : 0.0f;
    return length(p - a - d * t);
}

}  // namespace

SeamMap make_seam_map(std::span<const AtlasPart> parts, int size, int width_texels) {
    const Atlas atlas = find_charts(parts, float(size));
    const size_t count = size_t(size) * size_t(size);
    SeamMap map{
        .size = size, .carried = std::vector(count, Vec2{-1, -1}), .chart = std::vector<uint8_t>(count, 0)};
    fill_charts(atlas, map);
    const std::vector<uint8_t> covered = map.chart;
    std::vector<float> nearest(count, float(width_texels));
    for (uint32_t i = 0; i < atlas.sides.size(); ++i) {
        const Side& side = atlas.sides[i];
        const Side* beyond = atlas.partner[i] == kNone ? nullptr : &atlas.sides[atlas.partner[i]];
        if (beyond && beyond->uv[0] == side.uv[0] && beyond->uv[1] == side.uv[1]) continue;
        const EdgeFrame here(side);
        if (here.determinant == 0) continue;
        const EdgeFrame there = beyond ? EdgeFrame(*beyond) : here;
        visit_texels(std::span(side.uv, 2), float(width_texels), size, [&](size_t texel, Vec2 p) {
            if (covered[texel] != 0) return;
            const float distance = distance_to_segment(p, side.uv[0], side.uv[1]);
            if (distance >= nearest[texel]) return;
            const Vec2 mm = here.to_mm(p);
            if (mm.y > 0) return;
            nearest[texel] = distance;
            map.chart[texel] = uint8_t(atlas.chart[side.triangle]);
            map.carried[texel] = {-1, -1};
            if (!beyond || there.determinant == 0) return;
            const Vec2 target = there.to_uv({mm.x, -mm.y});
            const auto column = int(std::floor(target.x)), row = int(std::floor(target.y));
            const bool lands = column >= 0 && row >= 0 && column < size && row < size &&
                               covered[size_t(row) * size_t(size) + size_t(column)] ==
                                   uint8_t(atlas.chart[beyond->triangle]);
            if (lands) map.carried[texel] = target;
        });
    }
    return map;
}

}  // namespace dermis::inline mesh
