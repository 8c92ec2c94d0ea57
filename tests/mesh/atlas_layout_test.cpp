#include "dermis/mesh/atlas_layout.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/mesh/pack_charts.h"
#include "dermis/mesh/primitives.h"
#include "dermis/mesh/uv_report.h"

using namespace dermis;

namespace {

AtlasPart whole(const Mesh& mesh) {
    AtlasPart part{.mesh = &mesh, .triangles = {}};
    for (uint32_t t = 0; t < mesh.triangle_count(); ++t) part.triangles.push_back(t);
    return part;
}

// The layout as a mesh without shared vertices.
Mesh laid_out(std::span<const AtlasPart> parts, const AtlasLayout& layout) {
    Mesh all;
    for (size_t i = 0; i < parts.size(); ++i)
        for (size_t t = 0; t < parts[i].triangles.size(); ++t)
            for (size_t k = 0; k < 3; ++k) {
                const Mesh& mesh = *parts[i].mesh;
                all.positions_mm.push_back(
                    mesh.positions_mm[mesh.indices[3 * size_t(parts[i].triangles[t]) + k]]);
                all.uvs.push_back(layout.parts[i][t].uvs[k]);
                all.indices.push_back(uint32_t(all.indices.size()));
            }
    all.materials.resize(1);
    all.submeshes = {{.name = "all", .first_index = 0, .index_count = uint32_t(all.indices.size())}};
    return all;
}

void expect_clean(std::span<const AtlasPart> parts, const AtlasLayout& layout, double least_coverage) {
    ASSERT_FALSE(layout.is_as_it_was);
    const UvReport report = analyze_uvs(laid_out(parts, layout));
    EXPECT_EQ(report.tiles, std::vector<int>{1001});
    EXPECT_LT(report.overlap, 1e-3);
    EXPECT_GT(report.coverage, least_coverage);
    // Texels of equal size on all parts of the surface but for the layout's own stretch.
    EXPECT_LT(report.mm_per_texel_2048.p95, 3 * report.mm_per_texel_2048.p5);
}

// A grid of n by n materials on a square of skin, each with UVs over all of 0..1.
Mesh patches(uint32_t n) {
    Mesh mesh;
    for (uint32_t i = 0; i < n * n; ++i) {
        const float x = float(i % n), y = float(i / n);
        const auto base = uint32_t(mesh.positions_mm.size());
        for (const Vec2 at : {Vec2{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            mesh.positions_mm.push_back({x + at.x, y + at.y, 0});
            mesh.uvs.push_back({at.x, 1 - at.y});
        }
        for (const uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(base + k);
        mesh.submeshes.push_back({"", 6 * i, 6, i});
        mesh.materials.emplace_back();
    }
    return mesh;
}

}  // namespace

TEST(AtlasLayout, one_clean_tile_stays_as_it_is) {
    const Mesh ball = make_sphere(40, 20);
    const AtlasPart parts[] = {whole(ball)};
    EXPECT_TRUE(lay_out_atlas(parts).is_as_it_was);
    EXPECT_TRUE(lay_out_atlas({}).is_as_it_was);
}

TEST(AtlasLayout, two_objects_of_one_tile_get_texels_by_area) {
    const Mesh small = make_sphere(10, 20), large = make_sphere(20, 20);
    const AtlasPart parts[] = {whole(small), whole(large)};
    const AtlasLayout layout = lay_out_atlas(parts);
    EXPECT_EQ(layout.layers, 2u);
    expect_clean(parts, layout, 0.4);
}

TEST(AtlasLayout, other_tiles_and_uvs_across_borders_come_into_the_atlas) {
    Mesh moved = make_sphere(20, 20), across = make_sphere(20, 20);
    for (Vec2& uv : moved.uvs) uv = uv + Vec2{3, -2};
    for (Vec2& uv : across.uvs) uv = uv * 2 + Vec2{0.3f, -0.6f};
    for (const Mesh* mesh : {&moved, &across}) {
        const AtlasPart parts[] = {whole(*mesh)};
        expect_clean(parts, lay_out_atlas(parts), 0.3);
    }
}

TEST(AtlasLayout, mirrored_halves_get_texels_of_their_own) {
    Mesh plane = patches(1);
    Mesh other = plane;
    for (Vec3& p : other.positions_mm) p.x = -p.x;
    std::swap(other.indices[1], other.indices[2]), std::swap(other.indices[4], other.indices[5]);
    // One mesh, one material; both halves share the vertices of the seam at x = 0.
    plane.positions_mm.push_back({-1, 0, 0}), plane.uvs.push_back({1, 1});
    plane.positions_mm.push_back({-1, 1, 0}), plane.uvs.push_back({1, 0});
    for (const uint32_t i : {0u, 5u, 4u, 0u, 3u, 5u}) plane.indices.push_back(i);
    plane.submeshes[0].index_count = 12;
    const AtlasPart parts[] = {whole(plane)};
    const AtlasLayout layout = lay_out_atlas(parts);
    EXPECT_EQ(layout.layers, 2u);
    expect_clean(parts, layout, 0.4);
}

TEST(AtlasLayout, two_hundred_materials) {
    const Mesh mesh = patches(15);
    const AtlasPart parts[] = {whole(mesh)};
    const AtlasLayout layout = lay_out_atlas(parts);
    EXPECT_EQ(layout.layers, 225u);
    expect_clean(parts, layout, 0.6);
}

TEST(AtlasLayout, a_hundred_udim_tiles) {
    Mesh mesh = patches(10);
    for (size_t v = 0; v < mesh.uvs.size(); ++v)
        mesh.uvs[v] = mesh.uvs[v] + Vec2{float(v / 4 % 10), -float(v / 40)};
    mesh.materials.resize(1);
    mesh.submeshes = {{.name = "", .first_index = 0, .index_count = uint32_t(mesh.indices.size())}};
    const AtlasPart parts[] = {whole(mesh)};
    const AtlasLayout layout = lay_out_atlas(parts);
    EXPECT_EQ(layout.layers, 100u);
    expect_clean(parts, layout, 0.6);
}

TEST(AtlasLayout, degenerate_uvs_end_inside) {
    Mesh mesh = patches(2);
    for (size_t v = 0; v < 8; ++v) mesh.uvs[v] = {};
    const AtlasPart parts[] = {whole(mesh)};
    const AtlasLayout layout = lay_out_atlas(parts);
    for (const AtlasLayout::Corners& corners : layout.parts[0])
        for (const Vec2 uv : corners.uvs) {
            EXPECT_TRUE(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1) << uv.x << " " << uv.y;
        }
}

TEST(AtlasLayout, skin_without_uvs_is_unwrapped_beside_skin_that_has_some) {
    Mesh ball = make_sphere(20, 64);
    const Mesh plane = make_plane(30, 30, 4);
    ball.uvs.clear();
    const AtlasPart parts[] = {whole(ball), whole(plane)};
    const AtlasLayout layout = lay_out_atlas(parts);
    EXPECT_LT(layout.layers, 30u);
    expect_clean(parts, layout, 0.4);
}

namespace {

// Two turns of a spiral stair around the y axis, which cover each other in every projection along the mean of
// their normals. Its first step begins on the x axis.
void add_stair(Mesh& mesh, float inner_mm, float outer_mm) {
    constexpr int kSteps = 96;
    const auto base = uint32_t(mesh.positions_mm.size());
    for (int i = 0; i <= kSteps; ++i) {
        const float angle = 0.13f * float(i), y = 0.025f * outer_mm * float(i);
        for (const float radius : {inner_mm, outer_mm})
            mesh.positions_mm.push_back({radius * std::cos(angle), y, -radius * std::sin(angle)});
        if (i == kSteps) break;
        const auto k = base + uint32_t(2 * i);
        for (const uint32_t corner : {k, k + 1, k + 3, k, k + 3, k + 2}) mesh.indices.push_back(corner);
    }
}

double overlap_of(Mesh mesh) {
    mesh.materials.resize(1);
    mesh.submeshes = {{.name = "", .first_index = 0, .index_count = uint32_t(mesh.indices.size())}};
    const AtlasPart parts[] = {whole(mesh)};
    return analyze_uvs(laid_out(parts, lay_out_atlas(parts))).overlap;
}

}  // namespace

TEST(AtlasLayout, charts_that_cover_themselves_are_cut) {
    Mesh stair;
    add_stair(stair, 5, 20);
    EXPECT_LT(overlap_of(stair), 1e-4);
}

// As nostrils hang on a face: the stair covers 0.5 % of its chart twice.
TEST(AtlasLayout, a_small_part_that_covers_its_chart_gets_texels_of_its_own) {
    Mesh square;
    for (uint32_t i = 0; i <= 40; ++i)
        for (uint32_t k = 0; k <= 40; ++k) {
            square.positions_mm.push_back({-98 + 5 * float(k), 0, 5 * float(i)});
            if (i == 40 || k == 40) continue;
            const uint32_t at = 41 * i + k;
            for (const uint32_t corner : {at, at + 41, at + 1, at + 1, at + 41, at + 42})
                square.indices.push_back(corner);
        }
    add_stair(square, 2, 7);
    EXPECT_LT(overlap_of(square), 1e-4);
}

namespace {

// An L of two arms, each `arm` wide, of side `side`.
std::vector<std::array<Vec2, 3>> angle(float side, float arm) {
    std::vector<std::array<Vec2, 3>> triangles;
    for (const Vec2 size : {Vec2{side, arm}, {arm, side}}) {
        triangles.push_back({Vec2{}, {size.x, 0}, size});
        triangles.push_back({Vec2{}, size, {0, size.y}});
    }
    return triangles;
}

double distance(Vec2 p, Vec2 a, Vec2 b) {
    const Vec2 along = b - a;
    const float t = std::clamp(dot(p - a, along) / std::max(dot(along, along), 1e-12f), 0.0f, 1.0f);
    return double(length(p - a - along * t));
}

}  // namespace

TEST(PackCharts, lie_in_each_others_hollows_and_stay_apart) {
    constexpr float kGap = 0.02f;
    std::vector<std::vector<std::array<Vec2, 3>>> charts;
    for (int i = 0; i < 16; ++i) charts.push_back(angle(float(6 + i % 5), 2));
    const std::vector<PackedChart> packed = pack_charts(charts, kGap);
    ASSERT_EQ(packed.size(), charts.size());
    double area = 0, least = 1;
    for (size_t i = 0; i < charts.size(); ++i) {
        const float side = float(6 + i % 5), scale = length(packed[i].x_axis);
        EXPECT_NEAR(scale, length(packed[0].x_axis), 1e-6);
        EXPECT_GT(cross(packed[i].x_axis, packed[i].y_axis), 0) << "mirrored";
        area += double(scale * scale * (4 * side - 4));
        for (const std::array<Vec2, 3>& triangle : charts[i])
            for (const Vec2 corner : triangle) {
                const Vec2 at = packed[i].at(corner);
                least = std::min({least, double(at.x), double(at.y), 1 - double(at.x), 1 - double(at.y)});
                for (size_t k = 0; k < charts.size(); ++k)
                    for (const std::array<Vec2, 3>& other : charts[k])
                        for (size_t c = 0; k != i && c < 3; ++c)
                            least = std::min(
                                least,
                                distance(at, packed[k].at(other[c]), packed[k].at(other[(c + 1) % 3])) / 2);
            }
    }
    EXPECT_GE(least, 0.9 * double(kGap) / 2);
    EXPECT_GT(area, 0.45);  // boxes that touched would leave 0.43
}

TEST(PackCharts, fit_however_many_there_are) {
    const std::vector<std::vector<std::array<Vec2, 3>>> charts(5000, angle(3, 1));
    EXPECT_EQ(pack_charts(charts, 0.01f).size(), charts.size());
}
