#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "dermis/mesh/primitives.h"
#include "dermis/mesh/uv_report.h"
#include "mesh/mesh_files.h"

using namespace dermis;
using namespace dermis::test;

namespace {

// Of a 2048 map, by area, over the triangles that face `front` within 45 degrees and belong to the head, not
// the shoulders.
float median_mm_per_texel_of_front(const Mesh& mesh, Vec3 front) {
    const std::vector<UvMetric> metrics = triangle_uv_metrics(mesh);
    const std::vector<float> areas = triangle_areas_mm2(mesh);
    std::vector<std::pair<float, float>> samples;
    double total = 0;
    for (size_t t = 0; t < metrics.size(); ++t) {
        Vec3 n, middle;
        for (size_t k = 0; k < 3; ++k) {
            n += mesh.normals[mesh.indices[3 * t + k]];
            middle += mesh.positions_mm[mesh.indices[3 * t + k]] * (1.0f / 3);
        }
        if (dot(normalize(n), front) < 0.7f || std::abs(middle.x) > 75 || metrics[t].mm_per_uv() == 0)
            continue;
        samples.emplace_back(metrics[t].mm_per_uv() / 2048, areas[t]);
        total += areas[t];
    }
    std::ranges::sort(samples);
    double sum = 0;
    for (const auto& [mm, area] : samples)
        if ((sum += area) >= total / 2) return mm;
    return 0;
}

}  // namespace

TEST(Stretch, of_a_plane_is_its_size_in_millimetres) {
    const Mesh mesh = make_plane(100, 50, 3);
    for (const UvMetric& metric : triangle_uv_metrics(mesh)) {
        EXPECT_NEAR(metric.mm_per_u(), 100, 1e-2);
        EXPECT_NEAR(metric.mm_per_v(), 50, 1e-2);
        EXPECT_NEAR(metric.f_mm2, 0, 0.1);
        EXPECT_NEAR(metric.mm_per_uv(), std::sqrt(5000.0f), 1e-2);
        EXPECT_NEAR(metric.anisotropy(), 2, 1e-3);
    }
}

TEST(Stretch, of_a_shear_has_the_singular_values_of_its_matrix) {
    Mesh mesh = make_plane(1, 1);
    for (Vec3& p : mesh.positions_mm)
        p.x += p.y;  // P = (u + (1 - v), ...): singular values golden ratio and inverse
    const UvMetric metric = triangle_uv_metrics(mesh)[0];
    EXPECT_NEAR(metric.anisotropy(), std::pow(std::numbers::phi, 2), 1e-3);
    EXPECT_NEAR(metric.mm_per_uv(), 1, 1e-5);
    EXPECT_NEAR(metric.f_mm2, -1, 1e-5);
}

TEST(Stretch, of_a_spheres_vertices_shrinks_towards_its_poles) {
    const Mesh mesh = make_sphere(10, 128);
    const std::vector<UvMetric> metrics = vertex_uv_metrics(mesh);
    for (size_t i = 0; i < metrics.size(); ++i) {
        const float v = mesh.uvs[i].y;
        if (v < 0.1f || v > 0.9f) continue;
        const double ring_mm = 2 * std::numbers::pi * 10 * std::sin(v * std::numbers::pi);
        EXPECT_NEAR(metrics[i].mm_per_u() / ring_mm, 1, 0.06);
        EXPECT_NEAR(metrics[i].mm_per_v() / (std::numbers::pi * 10), 1, 0.01);
    }
}

TEST(Stretch, without_uv_area_is_zero_and_not_nan) {
    Mesh mesh = make_plane(1, 1);
    for (Vec2& uv : mesh.uvs) uv = {0.5f, 0.5f};
    for (const UvMetric& metric : vertex_uv_metrics(mesh)) {
        EXPECT_EQ(metric.mm_per_uv(), 0);
        EXPECT_EQ(metric.anisotropy(), 0);
    }
}

TEST(UvReport, of_a_plane_is_full_single_and_without_overlap) {
    const UvReport report = analyze_uvs(make_plane(204.8f, 204.8f, 7));
    EXPECT_EQ(report.coverage, 1) << "the edges that triangles share leave no gap";
    EXPECT_EQ(report.overlap, 0) << "and count once";
    EXPECT_EQ(report.charts, 1u);
    EXPECT_EQ(report.seam_length_mm, 0);
    EXPECT_EQ(report.tiles, std::vector<int>{1001});
    EXPECT_NEAR(report.mm_per_texel_2048.p50, 0.1, 1e-5);
    EXPECT_NEAR(report.anisotropy.p95, 1, 1e-4);
    EXPECT_EQ(report.area_mirrored, 0);
}

TEST(UvReport, counts_overlap_as_a_share_of_what_is_covered) {
    Mesh mesh = make_plane(1, 1, 2);
    // All UVs into the left half, then the right column of cells onto the left: half of the covered quarter
    // twice.
    for (Vec2& uv : mesh.uvs) uv.x = std::min(uv.x, 0.5f) + 0;
    for (Vec2& uv : mesh.uvs) uv.y *= 0.5f;
    UvReport report = analyze_uvs(mesh);
    EXPECT_NEAR(report.coverage, 0.25, 0.001);
    EXPECT_EQ(report.degenerate_triangles, 4u);
    mesh = make_box({10, 10, 10});
    for (size_t i = 4; i < 8; ++i) mesh.uvs[i] = mesh.uvs[i - 4];  // the second face onto the first
    report = analyze_uvs(mesh);
    EXPECT_NEAR(report.coverage, 5.0 / 6, 0.002);
    EXPECT_NEAR(report.overlap, 1.0 / 5, 0.002);
    EXPECT_EQ(report.charts, 6u);
    EXPECT_NEAR(report.seam_length_mm, 120, 1e-3);
}

TEST(UvReport, of_thousands_of_triangles_over_the_whole_tile_ends) {
    // Two triangles per copy, every copy over the others: one step per texel and triangle would be 4e10
    // steps.
    Mesh mesh;
    constexpr uint32_t kCopies = 20000;
    for (uint32_t copy = 0; copy < kCopies; ++copy) {
        const auto z = float(copy);
        for (const Vec2 uv : {Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1}, Vec2{0, 1}}) {
            mesh.positions_mm.push_back({uv.x, uv.y, z});
            mesh.uvs.push_back(uv);
        }
        for (const uint32_t corner : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(4 * copy + corner);
    }
    mesh.submeshes = {{.index_count = uint32_t(mesh.indices.size())}};
    const UvReport report = analyze_uvs(mesh);
    EXPECT_EQ(report.coverage, 1);
    EXPECT_EQ(report.overlap, 1);
    EXPECT_EQ(report.charts, kCopies);
}

TEST(UvReport, of_each_of_many_materials_is_that_of_its_triangles_alone) {
    Mesh mesh = make_box({10, 10, 10});
    const size_t faces = 6;
    mesh.submeshes.clear();
    mesh.materials.assign(faces, {});
    for (uint32_t face = 0; face < faces; ++face)
        mesh.submeshes.push_back({.first_index = 6 * face, .index_count = 6, .material = face});
    for (uint32_t face = 0; face < faces; ++face) {
        const UvReport report = analyze_uvs(mesh, face);
        EXPECT_NEAR(report.coverage, 1.0 / 6, 0.002) << face;
        EXPECT_EQ(report.charts, 1u);
        EXPECT_EQ(report.seam_length_mm, 0);
    }
}

TEST(UvReport, sees_mirrored_and_outlying_parts) {
    Mesh mesh = make_box({10, 10, 10});
    for (size_t i = 0; i < 4; ++i) mesh.uvs[i].x = 1.0f / 3 - mesh.uvs[i].x;
    EXPECT_NEAR(analyze_uvs(mesh).area_mirrored, 1.0 / 6, 1e-6);
    for (size_t i = 0; i < 4; ++i) mesh.uvs[i].x = mesh.uvs[i].x - 5;
    EXPECT_NEAR(analyze_uvs(mesh).area_outside, 1.0 / 6, 1e-6);
    for (size_t i = 0; i < 4; ++i) mesh.uvs[i] = mesh.uvs[i] + Vec2{6, -2};
    const UvReport report = analyze_uvs(mesh);
    EXPECT_EQ(report.tiles, (std::vector<int>{1001, 1022}));
    EXPECT_NEAR(report.coverage, 0.5, 0.002) << "five sixths of one tile and a sixth of another";
}

TEST(UvReport, names_tiles_by_their_number) {
    EXPECT_EQ(udim_tile({0.5f, 0.5f}), 1001);
    EXPECT_EQ(udim_tile({1.5f, 0.5f}), 1002);
    EXPECT_EQ(udim_tile({0.5f, -0.5f}), 1011) << "the second row is above the first";
    EXPECT_EQ(udim_tile({-0.5f, 0.5f}), 0);
    EXPECT_EQ(udim_tile({0.5f, 1.5f}), 0);
    EXPECT_EQ(udim_tile({NAN, 0}), 0);
    EXPECT_EQ(udim_tile({3e38f, -3e38f}), 0);
}

TEST(UvReport, is_finite_for_enormous_uvs) {
    Mesh mesh = make_plane(1, 1, 2);
    for (size_t i = 0; i < mesh.uvs.size(); i += 2) mesh.uvs[i] = mesh.uvs[i] * 3e38f;
    const UvReport report = analyze_uvs(mesh);
    EXPECT_TRUE(std::isfinite(report.coverage + report.overlap));
}

TEST(UvReport, measures_the_scanned_head_as_others_did) {
    if (!std::filesystem::exists(asset("lee_perry_smith/head.obj"))) GTEST_SKIP() << "no test head here";
    const auto loaded = read_mesh(asset("lee_perry_smith/head.obj"), {.unit_mm = 45});
    ASSERT_TRUE(loaded);
    const UvReport report = analyze_uvs(loaded->mesh);
    EXPECT_NEAR(report.coverage, 0.917, 0.001);
    EXPECT_NEAR(report.overlap, 0.0002, 0.0001);
    EXPECT_NEAR(report.anisotropy.p50, 2.0, 0.05);
    EXPECT_NEAR(report.anisotropy.p95, 4.1, 0.1);
    EXPECT_NEAR(median_mm_per_texel_of_front(loaded->mesh, {0, 0, -1}), 0.28, 0.01);
}
