#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "dermis/mesh/normals.h"
#include "dermis/mesh/tangents.h"
#include "mesh/mesh_files.h"

using namespace dermis;
using namespace dermis::test;

namespace {

Vec3 xyz(Vec4 v) {
    return {v.x, v.y, v.z};
}

Vec3 bitangent(const Mesh& mesh, size_t i) {
    return mesh.tangents[i].w * cross(mesh.normals[i], xyz(mesh.tangents[i]));
}

// A height field z = sin x cos y over a grid, with UVs sheared and scaled by a linear map.
Mesh wavy_grid(int n, Vec2 u_axis, Vec2 v_axis) {
    Mesh mesh;
    mesh.materials.resize(1);
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x) {
            const Vec2 p = {3.0f * x / n, 3.0f * y / n};
            mesh.positions_mm.push_back({p.x, p.y, std::sin(p.x) * std::cos(p.y)});
            mesh.normals.push_back(
                normalize({-std::cos(p.x) * std::cos(p.y), std::sin(p.x) * std::sin(p.y), 1}));
            mesh.uvs.push_back({dot(p, u_axis), dot(p, v_axis)});
        }
    for (uint32_t y = 0; y < uint32_t(n); ++y)
        for (uint32_t x = 0; x < uint32_t(n); ++x) {
            const uint32_t a = y * uint32_t(n + 1) + x, b = a + 1, c = b + uint32_t(n) + 1, d = c - 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
        }
    mesh.submeshes.push_back({"grid", 0, uint32_t(mesh.indices.size()), 0});
    return mesh;
}

}  // namespace

TEST(Tangents, follow_u_and_the_bitangent_points_up_in_the_image) {
    // u along +x, v downwards: up in the image is +y.
    Mesh mesh = wavy_grid(24, {1, 0}, {0, -1});
    compute_tangents(mesh);
    expect_sound(mesh);
    for (size_t i = 0; i < mesh.positions_mm.size(); ++i) {
        const Vec3 n = mesh.normals[i];
        const Vec3 dp_du = {1, 0, -n.x / n.z};  // of the surface itself
        EXPECT_GT(dot(normalize(dp_du), xyz(mesh.tangents[i])), 0.99f);
        EXPECT_GT(bitangent(mesh, i).y, 0.5f);
        EXPECT_EQ(mesh.tangents[i].w, 1);
    }
}

TEST(Tangents, mirrored_uvs_flip_the_sign_and_nothing_else) {
    Mesh mesh = wavy_grid(8, {-1, 0}, {0, -1});
    compute_tangents(mesh);
    for (size_t i = 0; i < mesh.positions_mm.size(); ++i) {
        EXPECT_LT(mesh.tangents[i].x, -0.5f);
        EXPECT_EQ(mesh.tangents[i].w, -1);
        EXPECT_GT(bitangent(mesh, i).y, 0.5f);
    }
}

TEST(Tangents, a_shear_of_the_uvs_keeps_frames_orthogonal_with_t_along_u) {
    Mesh mesh = wavy_grid(16, {1, 0.4f}, {0.2f, -1});
    compute_tangents(mesh);
    expect_sound(mesh);
    // dP/du of the linear map: the direction in which v stays.
    const Vec3 flat = normalize({1, 0.2f, 0});
    for (size_t i = 0; i < mesh.positions_mm.size(); ++i) {
        const Vec3 n = mesh.normals[i];
        const Vec3 on_surface = normalize(flat - Vec3{0, 0, (flat.x * n.x + flat.y * n.y) / n.z});
        EXPECT_GT(dot(on_surface, xyz(mesh.tangents[i])), 0.98f);
    }
}

TEST(Tangents, a_mirrored_seam_is_split) {
    // Two squares side by side; the right one's UVs mirror the left one's along their common edge.
    const auto loaded = parse_obj_text(
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
        "f 1/1 2/2 3/3 4/4\nf 2/2 5/1 6/4 3/3\n");
    ASSERT_TRUE(loaded);
    Mesh mesh = loaded->mesh;
    EXPECT_EQ(mesh.positions_mm.size(), 8u) << "six of the file, and the seam's two twice";
    size_t kept = 0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        for (size_t k = 0; k < 3; ++k) {
            const size_t vertex = mesh.indices[i + k];
            const bool left = i < 6;
            EXPECT_EQ(mesh.tangents[vertex].w, left ? 1 : -1);
            EXPECT_NEAR(mesh.tangents[vertex].x, left ? 1 : -1, 1e-6);
            kept += left;
        }
    EXPECT_EQ(kept, 6u);
}

TEST(Tangents, corners_weigh_by_their_angle) {
    // Around the origin a corner of 90 degrees whose u runs along x, and one of 45 degrees; both agree on the
    // UVs of their common edge. With u, v_up of (-1, 1, 0) at (-.5, 1.5) the second has dP/du = (2, 1, 0).
    Mesh mesh;
    mesh.materials.resize(1);
    mesh.positions_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 1, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.uvs = {{0, 0}, {1, 0}, {0, -1}, {-0.5f, -1.5f}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.submeshes = {{"", 0, 6, 0}};
    compute_tangents(mesh);
    const Vec3 expected = normalize(Vec3{1, 0, 0} * 90 + normalize({2, 1, 0}) * 45);
    EXPECT_NEAR(dot(xyz(mesh.tangents[0]), expected), 1, 1e-6);
}

TEST(Tangents, do_not_depend_on_the_order_of_vertices_and_triangles) {
    Mesh mesh = wavy_grid(10, {1, 0.3f}, {0, -1});
    Mesh shuffled = mesh;
    std::mt19937 random(1);
    std::vector<uint32_t> order(mesh.positions_mm.size()), place(order.size());
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::shuffle(order, random);
    for (uint32_t i = 0; i < order.size(); ++i) {
        place[order[i]] = i;
        shuffled.positions_mm[i] = mesh.positions_mm[order[i]];
        shuffled.normals[i] = mesh.normals[order[i]];
        shuffled.uvs[i] = mesh.uvs[order[i]];
    }
    std::vector<uint32_t> triangles(mesh.triangle_count());
    for (uint32_t i = 0; i < triangles.size(); ++i) triangles[i] = i;
    std::ranges::shuffle(triangles, random);
    for (size_t t = 0; t < triangles.size(); ++t)
        for (size_t k = 0; k < 3; ++k)  // each triangle also starts at another corner
            shuffled.indices[3 * t + k] = place[mesh.indices[3 * triangles[t] + (k + t) % 3]];
    compute_tangents(mesh);
    compute_tangents(shuffled);
    for (uint32_t i = 0; i < order.size(); ++i) {
        const Vec4 a = mesh.tangents[order[i]], b = shuffled.tangents[i];
        EXPECT_NEAR(dot(xyz(a), xyz(b)), 1, 1e-6);
        EXPECT_EQ(a.w, b.w);
    }
}

TEST(Tangents, triangles_without_uv_area_take_their_neighbours_frame) {
    Mesh mesh = wavy_grid(6, {1, 0}, {0, -1});
    // One cell's UVs collapse onto a line; its corners elsewhere keep their frames.
    for (const uint32_t corner : {0u, 1u, 2u}) mesh.uvs[mesh.indices[corner]].y = 0;
    mesh.uvs[mesh.indices[2]].x = 0.25f;
    compute_tangents(mesh);
    expect_sound(mesh);
    for (const Vec4& t : mesh.tangents) EXPECT_GT(std::abs(t.x), 0.1f);
}

TEST(Tangents, uvs_that_are_all_one_point_or_absent_still_give_frames) {
    for (const bool absent : {false, true}) {
        Mesh mesh = wavy_grid(4, {0, 0}, {0, 0});
        if (absent) mesh.uvs.clear();
        compute_tangents(mesh);
        ASSERT_EQ(mesh.tangents.size(), mesh.positions_mm.size());
        expect_sound(mesh);
    }
}

TEST(Tangents, extreme_uvs_and_slivers_never_give_nan) {
    std::mt19937 random(7);
    const std::vector<float> values = {0, 1e-38f, -1e-30f, 1e-7f, 1, -1, 1e7f, 3e38f, -3e38f};
    std::uniform_int_distribution<size_t> pick(0, values.size() - 1), pick_position(0, 6);
    for (int round = 0; round < 300; ++round) {
        Mesh mesh = wavy_grid(2, {1, 0}, {0, 1});
        for (Vec2& uv : mesh.uvs) uv = {values[pick(random)], values[pick(random)]};
        for (Vec3& p : mesh.positions_mm)
            p = {values[pick_position(random)], values[pick_position(random)], 0};
        compute_normals(mesh);
        compute_tangents(mesh);
        expect_sound(mesh);
    }
}

TEST(Tangents, given_ones_are_made_orthogonal_and_the_others_computed) {
    Mesh mesh = wavy_grid(2, {1, 0}, {0, -1});
    mesh.tangents.assign(mesh.positions_mm.size(), Vec4{2, 0, 0.5f, -0.3f});
    complete_tangents(mesh);
    expect_sound(mesh);
    EXPECT_EQ(mesh.tangents[0].w, -1);
    const std::vector<Vec4> straightened = mesh.tangents;
    Mesh computed = mesh;
    compute_tangents(computed);
    EXPECT_EQ(computed.tangents[1].w, 1) << "which tells them apart";
    for (const Vec4 unusable :
         {Vec4{}, Vec4{NAN, 0, 0, 1}, Vec4{mesh.normals[1].x, mesh.normals[1].y, mesh.normals[1].z, 1}}) {
        mesh.tangents = straightened;
        mesh.tangents[1] = unusable;
        complete_tangents(mesh);
        EXPECT_NEAR(mesh.tangents[0].x, straightened[0].x, 1e-6);
        EXPECT_EQ(mesh.tangents[0].w, -1);
        EXPECT_EQ(mesh.tangents[1], computed.tangents[1]);
    }
}

TEST(Tangents, the_scanned_head_gets_sound_frames_of_the_right_hand_and_few_splits) {
    if (!std::filesystem::exists(asset("lee_perry_smith/head.obj"))) GTEST_SKIP() << "no test head here";
    const auto loaded = read_mesh(asset("lee_perry_smith/head.obj"), {.unit_mm = 45});
    ASSERT_TRUE(loaded);
    ASSERT_EQ(loaded->mesh.tangents.size(), loaded->mesh.positions_mm.size());
    expect_sound(loaded->mesh);
    const Mesh& mesh = loaded->mesh;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto uv = [&](size_t k) { return mesh.uvs[mesh.indices[i + k]]; };
        const float area = cross(uv(1) - uv(0), uv(2) - uv(0));  // v points down: mirrored when positive
        for (size_t k = 0; k < 3 && std::abs(area) > 1e-9f; ++k)
            EXPECT_EQ(mesh.tangents[mesh.indices[i + k]].w, area > 0 ? -1 : 1);
    }
    EXPECT_LT(mesh.positions_mm.size(), 9400u) << "9,203 in the file";
}
