#include <gtest/gtest.h>

#include "dermis/mesh/normals.h"
#include "mesh/mesh_files.h"

using namespace dermis;
using namespace dermis::test;

namespace {

Mesh cube() {
    return std::move(parse_obj_text(kCubeObj)->mesh);
}

}  // namespace

TEST(Normals, a_cube_smooths_to_its_diagonals_whatever_its_triangulation_and_seams) {
    Mesh mesh = cube();
    EXPECT_GT(mesh.positions_mm.size(), 8u) << "the UV seams split its vertices";
    compute_normals(mesh);
    for (size_t i = 0; i < mesh.positions_mm.size(); ++i) {
        const Vec3 diagonal = normalize(mesh.positions_mm[i]);
        EXPECT_NEAR(dot(mesh.normals[i], diagonal), 1, 1e-6)
            << "angle weights are independent of the diagonals";
    }
}

TEST(Normals, a_crease_angle_keeps_a_cubes_edges_sharp) {
    Mesh mesh = cube();
    compute_normals(mesh, {.crease_angle_deg = 60});
    expect_sound(mesh);
    EXPECT_EQ(mesh.positions_mm.size(), 24u);
    for (const Vec3& n : mesh.normals)
        EXPECT_NEAR(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}), 1, 1e-6);
}

TEST(Normals, surfaces_that_touch_in_a_point_are_kept_apart) {
    // Two triangles of different planes with one common position and no common edge.
    const auto loaded = parse_obj_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 -1 1\nf 1 2 3\nf 1 4 5\n");
    ASSERT_TRUE(loaded);
    EXPECT_EQ(loaded->mesh.positions_mm.size(), 6u);
    EXPECT_EQ(loaded->mesh.normals[loaded->mesh.indices[0]], (Vec3{0, 0, 1}));
    EXPECT_EQ(loaded->mesh.normals[loaded->mesh.indices[3]], (Vec3{-1, 0, 0}));
}

TEST(Normals, a_folded_surface_whose_normals_cancel_keeps_each_sides_own) {
    const auto loaded = parse_obj_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n");
    ASSERT_TRUE(loaded);
    expect_sound(loaded->mesh);
    EXPECT_EQ(loaded->mesh.normals[loaded->mesh.indices[0]], (Vec3{0, 0, 1}));
    EXPECT_EQ(loaded->mesh.normals[loaded->mesh.indices[3]], (Vec3{0, 0, -1}));
}

TEST(Normals, a_file_that_lacks_some_gets_only_those_computed) {
    const auto loaded = parse_obj_text(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0.6 0.8\nvn nan 0 0\nf 1//1 2//2 3\nf 2//2 4 3\n");
    ASSERT_TRUE(loaded) << loaded.error().message;
    expect_sound(loaded->mesh);
    EXPECT_EQ(loaded->mesh.normals[loaded->mesh.indices[0]], (Vec3{0, 0.6f, 0.8f}));
    EXPECT_EQ(loaded->mesh.normals[loaded->mesh.indices[1]], (Vec3{0, 0, 1}));
}

TEST(Normals, reversed_winding_is_noticed) {
    const std::string reversed = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 3//1 2//1\n";
    EXPECT_TRUE(any_contains(parse_obj_text(reversed)->warnings, "100 % of the triangles face against"));
    EXPECT_FALSE(any_contains(parse_obj_text(kCubeObj)->warnings, "against"));
}

TEST(Normals, a_micrometre_mesh_and_a_degenerate_one_stay_finite) {
    const auto tiny = parse_obj_text("v 0 0 0\nv 1e-20 0 0\nv 0 1e-20 0\nf 1 2 3\n");
    ASSERT_TRUE(tiny);
    EXPECT_EQ(tiny->mesh.normals[0], (Vec3{0, 0, 1}));
    const auto line = parse_obj_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    ASSERT_TRUE(line);
    expect_sound(line->mesh);
}
