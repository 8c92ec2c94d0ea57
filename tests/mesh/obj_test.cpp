#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/mesh_files.h"

using namespace dermis;
using namespace dermis::test;

namespace {

std::string error_of(const std::string& text) {
    const auto loaded = parse_obj_text(text);
    return loaded ? "" : loaded.error().message;
}

}  // namespace

TEST(Obj, a_cube_of_quads_becomes_twelve_triangles) {
    const auto loaded = parse_obj_text(kCubeObj);
    ASSERT_TRUE(loaded) << loaded.error().message;
    expect_sound(loaded->mesh);
    EXPECT_EQ(loaded->mesh.triangle_count(), 12u);
    EXPECT_NEAR(area_mm2(loaded->mesh), 24, 1e-5);
}

TEST(Obj, uv_origin_becomes_top_left) {
    const auto loaded = parse_obj_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0.1\nf 1/1 2/1 3/1\n");
    ASSERT_TRUE(loaded);
    EXPECT_FLOAT_EQ(loaded->mesh.uvs[0].x, 0.25f);
    EXPECT_FLOAT_EQ(loaded->mesh.uvs[0].y, 0.9f);
}

TEST(Obj, negative_indices_count_from_the_end) {
    const auto loaded = parse_obj_text("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->mesh.positions_mm.size(), 3u) << "the first vertex is unused";
    EXPECT_EQ(loaded->mesh.positions_mm[loaded->mesh.indices[1]], (Vec3{1, 0, 0}));
    EXPECT_NE(error_of("v 0 0 0\nf -2 -1 -1\n").find(":2: vertex index -2 is out of range"),
              std::string::npos);
}

TEST(Obj, a_concave_polygon_keeps_its_area) {
    // An L of area 3, and an arrow-head quad whose short diagonal lies outside.
    const auto l_shape =
        parse_obj_text("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5 6\n");
    ASSERT_TRUE(l_shape);
    EXPECT_EQ(l_shape->mesh.triangle_count(), 4u);
    EXPECT_NEAR(area_mm2(l_shape->mesh), 3, 1e-6);
    const auto arrow = parse_obj_text("v 0 0 0\nv 2 -1 0\nv 0.5 0 0\nv 2 1 0\nf 1 2 3 4\n");
    ASSERT_TRUE(arrow);
    EXPECT_NEAR(area_mm2(arrow->mesh), 0.5, 1e-6);
}

TEST(Obj, forms_of_corners_comments_continuations_and_carriage_returns_are_read) {
    const auto loaded = parse_obj_text(
        "# comment\r\no thing\r\nv 0 0 0 # a\r\nv 1 0 \\\r\n0\r\nv 0 1 0 1.0\r\nvn 0 0 2\r\nvt 0.5\r\ns 1\r\n"
        "f 1//1 2//1 3//1 # b\r\nf 1/1/1 2/1/1 3/1/1\r\n");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->mesh.triangle_count(), 2u);
    expect_sound(loaded->mesh);
    EXPECT_EQ(loaded->mesh.normals[0], (Vec3{0, 0, 1}));
    EXPECT_TRUE(any_contains(loaded->warnings, "3 face corners have no UV"));
}

TEST(Obj, materials_become_submeshes_in_order_of_first_use) {
    const std::string text =
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl skin\nf 1 2 3\nusemtl eye\nf 1 3 2\n"
        "usemtl skin\nf 2 3 1\nusemtl hair\nf 3 1 2\n";
    const std::string mtl =
        "newmtl eye\nKd 0.5 0.25 0\nNs 98\nNi 1.4\nd 0.5\nmap_Kd -s 1 1 1 tex/eye colour.png\n"
        "newmtl skin\nPr 0.3\nmap_Bump -bm 0.5 skin_normal.png\nmap_Kd ../out.png\n";
    const auto loaded = parse_obj_text(text, {{"m.mtl", mtl}});
    ASSERT_TRUE(loaded) << loaded.error().message;
    const Mesh& mesh = loaded->mesh;
    ASSERT_EQ(mesh.submeshes.size(), 3u);
    EXPECT_EQ(mesh.submeshes[0].name, "skin");
    EXPECT_EQ(mesh.submeshes[0].index_count, 6u);
    const Material& skin = mesh.materials[mesh.submeshes[0].material];
    EXPECT_FLOAT_EQ(skin.roughness, 0.3f);
    EXPECT_EQ(skin.normal_map.name, "dir/skin_normal.png");
    EXPECT_FLOAT_EQ(skin.normal_scale, 0.5f);
    EXPECT_FALSE(skin.base_color_map.present()) << "it lies outside the directory";
    const Material& eye = mesh.materials[mesh.submeshes[1].material];
    EXPECT_EQ(eye.base_color_linear, (Vec3{0.5f, 0.25f, 0}));
    EXPECT_EQ(eye.base_color_map.name, "dir/tex/eye colour.png");
    EXPECT_FLOAT_EQ(eye.ior, 1.4f);
    EXPECT_FLOAT_EQ(eye.opacity, 0.5f);
    EXPECT_NEAR(eye.roughness, std::pow(0.02, 0.25), 1e-5);
    EXPECT_TRUE(any_contains(loaded->warnings, "'hair'"));
    EXPECT_TRUE(any_contains(loaded->warnings, "'../out.png' lies outside"));
}

TEST(Obj, what_is_wrong_is_named_with_its_line) {
    EXPECT_NE(error_of("").find("no vertices"), std::string::npos);
    EXPECT_NE(error_of("v 0 0 0\nv 1 0 0\nv 0 1 0\n").find("no faces"), std::string::npos);
    EXPECT_NE(error_of("v 0 0\n").find("dir/test.obj:1: a vertex needs three numbers"), std::string::npos);
    EXPECT_NE(error_of("v 0 0 0\nv nan 0 0\n").find(":2: a vertex position must be finite"),
              std::string::npos);
    EXPECT_NE(error_of("v 0 0 inf\n").find("finite"), std::string::npos);
    EXPECT_NE(error_of("v 0 0 1e99\n").find("finite"), std::string::npos);
    EXPECT_EQ(error_of("v 0 0 1e-99\nv 1 0 0\nv 0 1 0\nf 1 2 3"), "");
    EXPECT_NE(error_of("v 0 0 0\nf 1 2 3\n").find(":2: vertex index 2 is out of range (the file has 1)"),
              std::string::npos);
    EXPECT_NE(error_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2/1 3/1\n").find("UV index 1"), std::string::npos);
    EXPECT_NE(error_of("v 0 0 0\nf 0 0 0\n").find("index 0"), std::string::npos);
    EXPECT_NE(error_of("v 0 0 0\nf 99999999999999999999 1 1\n").find("a face corner is"), std::string::npos);
    EXPECT_NE(error_of("v 0 0 0\nf a b c\n").find("a face corner is"), std::string::npos);
}

TEST(Obj, too_many_vertices_are_refused) {
    const auto loaded = parse_obj_text(kCubeObj, {}, {.max_vertices = 7});
    ASSERT_FALSE(loaded);
    EXPECT_NE(loaded.error().message.find("more than 7 vertices"), std::string::npos);
}

TEST(Obj, degenerate_faces_are_skipped_or_harmless) {
    const auto loaded =
        parse_obj_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 1 2\nf 1 1 2\nf 1 2 4\nf 1 2 3 1\n");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->mesh.triangle_count(), 3u);
    expect_sound(loaded->mesh);
    EXPECT_TRUE(any_contains(loaded->warnings, "2 faces with fewer than three corners"));
}

TEST(Obj, a_missing_mtl_is_reported_unless_the_caller_has_materials) {
    const std::string text = "mtllib none.mtl\nv 0 0 0\nv 200 0 0\nv 0 200 0\nvt 0 0\nf 1/1 2/1 3/1\n";
    const auto told = parse_obj_text(text),
               quiet = parse_obj_text(text, {}, {.ignore_missing_materials = true});
    ASSERT_TRUE(told && quiet);
    EXPECT_EQ(told->warnings.size(), quiet->warnings.size() + 1);
    EXPECT_NE(told->warnings[0].find("material library not read"), std::string::npos) << told->warnings[0];
}

TEST(Obj, every_prefix_loads_or_fails_cleanly) {
    const std::string text = "mtllib a.mtl\nusemtl b\n" + kCubeObj;
    const std::string mtl = "newmtl b\nKd 1 0.5 0\nmap_Kd -o 1 2 3 -bm 0.5 x.png\nbump n.png\nd 0.5\n";
    for (size_t size = 0; size <= text.size(); ++size) {
        const auto loaded =
            parse_obj_text(text.substr(0, size), {{"a.mtl", mtl.substr(0, size % (mtl.size() + 1))}});
        if (loaded)
            expect_sound(loaded->mesh);
        else
            EXPECT_EQ(loaded.error().message.find('\n'), std::string::npos);
    }
}

TEST(Obj, the_unit_scales_and_a_height_no_head_has_is_warned_of) {
    const auto small = parse_obj_text(kCubeObj);
    EXPECT_TRUE(any_contains(small->warnings, "2 mm tall; a head is 150 to 500 mm; OBJ has no unit"));
    const auto head = parse_obj_text(kCubeObj, {}, {.unit_mm = 120});
    EXPECT_FALSE(any_contains(head->warnings, "tall"));
    EXPECT_EQ(head->mesh.positions_mm[0], (Vec3{-120, -120, 120}));
    EXPECT_FALSE(parse_obj_text(kCubeObj, {}, {.unit_mm = 0}));
    EXPECT_FALSE(parse_obj_text(kCubeObj, {}, {.unit_mm = 1e39}));
}

TEST(Obj, udim_tiles_are_named_by_material) {
    const auto loaded = parse_obj_text(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.1 0.1\nvt 0.9 0.1\nvt 0.1 0.9\nvt 1.1 1.1\nvt 1.9 1.1\nvt 1.1 1.9\n"
        "usemtl face\nf 1/1 2/2 3/3\nusemtl eye\nf 1/4 2/5 3/6\n");
    ASSERT_TRUE(loaded);
    EXPECT_TRUE(any_contains(loaded->warnings, "'face' 1001, 'eye' 1012"));
    EXPECT_FALSE(any_contains(parse_obj_text(kCubeObj)->warnings, "UDIM"));
}

TEST(ReadMesh, files_that_are_no_mesh_give_one_line) {
    EXPECT_NE(read_mesh("/no/such.obj").error().message.find("cannot open"), std::string::npos);
    EXPECT_NE(read_mesh("picture.png").error().message.find(".obj, .gltf or .glb"), std::string::npos);
    EXPECT_FALSE(read_mesh("/"));
}

TEST(ReadMesh, paths_that_leave_the_directory_are_refused) {
    for (const char* inside : {"a.bin", "sub/a.bin", "..a/b", "a b.png"})
        EXPECT_TRUE(stays_inside(inside)) << inside;
    for (const char* outside :
         {"", "/etc/passwd", "../a", "a/../../b", "a/..", "C:\\a", "http://x/a", "..\\a"})
        EXPECT_FALSE(stays_inside(outside)) << outside;
}

TEST(ReadMesh, the_scanned_head_loads_as_its_readme_says) {
    if (!std::filesystem::exists(asset("lee_perry_smith/head.obj"))) GTEST_SKIP() << "no test head here";
    const auto triangles = read_mesh(asset("lee_perry_smith/head.obj"), {.unit_mm = 45});
    const auto quads = read_mesh(asset("lee_perry_smith/head_quads.obj"), {.unit_mm = 900});
    ASSERT_TRUE(triangles && quads);
    EXPECT_EQ(triangles->mesh.triangle_count(), 17684u);
    EXPECT_EQ(quads->mesh.triangle_count(), 17684u);
    EXPECT_FALSE(any_contains(triangles->warnings, "tall"));
    EXPECT_FALSE(any_contains(quads->warnings, "tall"));
    expect_sound(triangles->mesh);
    expect_sound(quads->mesh);
}

TEST(ReadMesh, the_face_of_many_materials_loads) {
    if (!std::filesystem::exists(asset("ict_face/ict_neutral.obj"))) GTEST_SKIP() << "no test face here";
    const auto loaded = read_mesh(asset("ict_face/ict_neutral.obj"), {.unit_mm = 10});
    ASSERT_TRUE(loaded);
    expect_sound(loaded->mesh);
    EXPECT_EQ(loaded->mesh.submeshes.size(), 12u);
    EXPECT_EQ(loaded->mesh.submeshes[0].name, "M_Face");
    EXPECT_TRUE(any_contains(loaded->warnings, "'M_Face' 1001, 'M_BackHead' 1002"));
}
