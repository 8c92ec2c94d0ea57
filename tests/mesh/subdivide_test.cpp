#include <gtest/gtest.h>

#include <numbers>

#include "dermis/mesh/normals.h"
#include "dermis/mesh/obj.h"
#include "dermis/mesh/primitives.h"
#include "dermis/mesh/subdivide.h"
#include "dermis/mesh/topology.h"
#include "dermis/mesh/uv_report.h"
#include "mesh/mesh_files.h"
#include "test_parts.h"

using namespace dermis;
using namespace dermis::test;

namespace {

PolygonMesh cage_of(const std::string& text) {
    return parse_obj(text, "cage.obj", {}, {})->polygons;
}

}  // namespace

TEST(Subdivide, each_level_makes_four_quads_of_one) {
    DERMIS_NEEDS(SUBDIVISION);
    const PolygonMesh cube = cage_of(kCubeObj);
    for (int level = 0; level <= 3; ++level) {
        const auto refined = subdivide(cube, level);
        ASSERT_TRUE(refined) << refined.error().message;
        EXPECT_EQ(refined->face_count(), 6u << (2 * level));
        Mesh mesh = triangulate(*refined);
        complete_normals(mesh);
        expect_sound(mesh);
    }
}

TEST(Subdivide, a_cubes_corner_goes_to_its_known_limit) {
    DERMIS_NEEDS(SUBDIVISION);
    // For valence 3 the limit weighs the corner 9, each edge neighbour 4, each face's opposite corner 1, over
    // 24 (Halstead et al. 1993: n^2, 4 and 1 over n (n + 5)). By symmetry it lies on the diagonal.
    const auto refined = subdivide(cage_of(kCubeObj), 1);
    ASSERT_TRUE(refined);
    const double diagonal =
        (9 * 1 + 4 * 1 + 1 * -1) / 24.0;  // per coordinate: corner 1, edges 1+1-1, faces 1-1-1
    float nearest = 1e9f;
    for (const Vec3& p : refined->positions_mm)
        nearest = std::min(nearest, length(p - Vec3{1, 1, 1} * float(diagonal)));
    EXPECT_LT(nearest, 1e-5f);
}

TEST(Subdivide, limit_positions_do_not_depend_on_the_level) {
    DERMIS_NEEDS(SUBDIVISION);
    const PolygonMesh cube = cage_of(kCubeObj);
    const auto coarse = subdivide(cube, 1), fine = subdivide(cube, 3);
    ASSERT_TRUE(coarse && fine);
    for (size_t i = 0; i < coarse->positions_mm.size(); ++i) {
        float nearest = 1e9f;
        for (const Vec3& p : fine->positions_mm)
            nearest = std::min(nearest, length(p - coarse->positions_mm[i]));
        EXPECT_LT(nearest, 1e-4f);
    }
}

TEST(Subdivide, limit_normals_agree_with_the_triangles) {
    DERMIS_NEEDS(SUBDIVISION);
    const auto refined = subdivide(cage_of(kCubeObj), 4);
    ASSERT_TRUE(refined);
    Mesh mesh = triangulate(*refined), computed = mesh;
    compute_normals(computed);
    for (size_t i = 0; i < mesh.indices.size(); ++i)
        EXPECT_GT(dot(mesh.normals[mesh.indices[i]], computed.normals[computed.indices[i]]), 0.995f);
}

TEST(Subdivide, uv_borders_stay_where_they_were) {
    DERMIS_NEEDS(SUBDIVISION);
    // Two quads whose chart bends at (1, 0) and (1, 1) of the file: a smooth border would cut the bend.
    const auto refined =
        subdivide(cage_of("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nvt 0 0\nvt 1 0\n"
                          "vt 2 0.5\nvt 0 1\nvt 1 1\nvt 2 1.5\nf 1/1 2/2 5/5 4/4\nf 2/2 3/3 6/6 5/5\n"),
                  2);
    ASSERT_TRUE(refined);
    for (const Vec2 corner : {Vec2{0, 1}, {1, 1}, {2, 0.5f}, {0, 0}, {1, 0}, {2, -0.5f}}) {
        float nearest = 1;
        for (const Vec2& uv : refined->uvs) nearest = std::min(nearest, length(uv - corner));
        EXPECT_LT(nearest, 1e-6f) << corner.x << ' ' << corner.y;
    }
}

TEST(Subdivide, materials_follow_their_faces_and_open_borders_stay) {
    DERMIS_NEEDS(SUBDIVISION);
    const auto refined =
        subdivide(cage_of("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nusemtl a\nf 1 2 3 4\n"
                          "usemtl b\nf 2 5 6 3\n"),
                  2);
    ASSERT_TRUE(refined);
    const Mesh mesh = triangulate(*refined);
    ASSERT_EQ(mesh.submeshes.size(), 2u);
    EXPECT_EQ(mesh.submeshes[0].index_count, 16u * 6);
    EXPECT_EQ(mesh.submeshes[1].index_count, 16u * 6);
    for (const Vec3& n : mesh.normals) EXPECT_NEAR(n.z, 1, 1e-5);
}

TEST(Subdivide, a_cage_of_triangles_tends_to_its_shape) {
    DERMIS_NEEDS(SUBDIVISION);
    const auto refined = subdivide(polygons_of(make_sphere(10, 24)), 2);
    ASSERT_TRUE(refined) << refined.error().message;
    for (const Vec3& p : refined->positions_mm) EXPECT_NEAR(length(p), 10, 0.35);
}

TEST(Subdivide, what_cannot_be_refined_is_an_error) {
    DERMIS_NEEDS(SUBDIVISION);
    EXPECT_FALSE(subdivide(cage_of(kCubeObj), -1));
    EXPECT_FALSE(subdivide(cage_of(kCubeObj), 6));
    const auto huge = subdivide(polygons_of(make_plane(1, 1, 200)), 5);
    ASSERT_FALSE(huge);
    EXPECT_NE(huge.error().message.find("more than 20 million"), std::string::npos);
    PolygonMesh twice = cage_of(kCubeObj);
    twice.corner_positions[2] = twice.corner_positions[0];
    const auto refined = subdivide(twice, 1);
    if (refined) {
        for (const Vec3& p : refined->positions_mm) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
    }
}

TEST(Subdivide, copies_of_a_face_have_limits_but_no_normals) {
    DERMIS_NEEDS(SUBDIVISION);
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int copy = 0; copy < 40; ++copy) text += "f 1 2 3\n";
    for (const int level : {1, 2}) {
        const auto refined = subdivide(cage_of(text), level);
        ASSERT_TRUE(refined) << refined.error().message;
        EXPECT_TRUE(refined->normals.empty());
        Mesh mesh = triangulate(*refined);
        complete_normals(mesh);
        expect_sound(mesh);
    }
    EXPECT_FALSE(subdivide(cage_of(kCubeObj), 1)->normals.empty());
}

TEST(Subdivide, the_scanned_head_refines_with_its_uvs) {
    DERMIS_NEEDS(SUBDIVISION);
    if (!std::filesystem::exists(asset("lee_perry_smith/head_quads.obj")))
        GTEST_SKIP() << "no test head here";
    const auto loaded =
        read_mesh(asset("lee_perry_smith/head_quads.obj"), {.unit_mm = 900, .subdivision_level = 1});
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->mesh.triangle_count(), 4u * 17684);
    expect_sound(loaded->mesh);
    const UvReport report = analyze_uvs(loaded->mesh);
    EXPECT_NEAR(report.coverage, 0.917, 0.01);
    EXPECT_LT(report.overlap, 0.002);
    EXPECT_LT(report.charts, 20u) << "its UV corners are joined by value";
}

TEST(Subdivide, is_refused_where_it_is_not_built_in) {
    if (DERMIS_WITH_SUBDIVISION) GTEST_SKIP() << "SUBDIVISION is built in";
    EXPECT_TRUE(subdivide(cage_of(kCubeObj), 0));
    EXPECT_EQ(subdivide(cage_of(kCubeObj), 1).error().message,
              "subdivision is not built in; configure dermis with -DDERMIS_WITH_SUBDIVISION=ON");
}

TEST(Displace, lifts_along_the_normal_in_millimetres) {
    Mesh mesh = make_sphere(10, 64);
    displace(mesh, [](Vec2) { return 0.75f; }, {.mid = 0.5f, .amplitude_mm = 8});
    for (const Vec3& p : mesh.positions_mm) EXPECT_NEAR(length(p), 12, 1e-3);
    expect_sound(mesh);
}

TEST(Displace, opens_no_crack_along_a_seam) {
    Mesh mesh = make_sphere(10, 32);
    displace(mesh, [](Vec2 uv) { return uv.x; }, {.mid = 0, .amplitude_mm = 1});
    // Both sides of the seam (u = 0 and u = 1) end at the mean of their heights.
    for (size_t i = 0; i < mesh.positions_mm.size(); ++i)
        if ((mesh.uvs[i].x == 0 || mesh.uvs[i].x == 1) && mesh.uvs[i].y > 0 && mesh.uvs[i].y < 1) {
            EXPECT_NEAR(length(mesh.positions_mm[i]), 10.5, 1e-3);
        }
    EXPECT_EQ(weld_positions(mesh.positions_mm).count(),
              weld_positions(make_sphere(10, 32).positions_mm).count());
}
