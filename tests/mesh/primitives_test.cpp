#include <gtest/gtest.h>

#include <algorithm>

#include "dermis/mesh/normals.h"
#include "dermis/mesh/primitives.h"
#include "dermis/mesh/tangents.h"
#include "dermis/mesh/topology.h"
#include "mesh/mesh_files.h"

using namespace dermis;
using namespace dermis::test;

namespace {

struct Shape {
    const char* name;
    Mesh mesh;
};

std::vector<Shape> all_shapes() {
    return {{"sphere", make_sphere(10, 48)},
            {"torus", make_torus(20, 6, 64)},
            {"cylinder", make_cylinder(8, 30, 48)},
            {"plane", make_plane(10, 20, 4)},
            {"box", make_box({1, 2, 3})}};
}

}  // namespace

TEST(Primitives, carry_every_attribute_and_face_outwards) {
    for (const auto& [name, mesh] : all_shapes()) {
        SCOPED_TRACE(name);
        expect_sound(mesh);
        EXPECT_EQ(mesh.tangents.size(), mesh.positions_mm.size());
        EXPECT_EQ(mesh.curvatures_per_mm.size(), mesh.positions_mm.size());
        EXPECT_EQ(fraction_facing_backwards(mesh), 0);
        for (const Vec2& uv : mesh.uvs) EXPECT_TRUE(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1);
    }
}

TEST(Primitives, close_without_a_gap_wherever_their_shape_does) {
    for (const auto& [name, mesh] : all_shapes()) {
        const std::string shape = name;
        if (shape == "plane" || shape == "cylinder") continue;
        const Weld weld = weld_positions(mesh.positions_mm);
        std::map<std::pair<uint32_t, uint32_t>, int> directed;
        for (uint32_t corner = 0; corner < mesh.indices.size(); ++corner)
            ++directed[{weld.ids[mesh.indices[corner]], weld.ids[mesh.indices[next_corner(corner)]]}];
        for (const auto& [edge, count] : directed) {
            EXPECT_EQ(count, 1) << shape;
            EXPECT_EQ(directed.count({edge.second, edge.first}), 1u) << shape;
        }
    }
}

TEST(Primitives, computed_normals_and_tangents_come_out_as_the_analytic_ones) {
    for (const auto& [name, exact] : all_shapes()) {
        if (std::string(name) == "box") continue;
        SCOPED_TRACE(name);
        Mesh mesh = exact;
        compute_normals(mesh);
        ASSERT_EQ(mesh.positions_mm.size(), exact.positions_mm.size());
        for (size_t i = 0; i < mesh.normals.size(); ++i) {
            const bool on_border =
                std::string(name) == "cylinder" && (exact.uvs[i].y == 0 || exact.uvs[i].y == 1);
            if (on_border) continue;
            EXPECT_GT(dot(mesh.normals[i], exact.normals[i]), 0.9995f);
        }
        mesh = exact;
        compute_tangents(mesh);
        for (size_t i = 0; i < exact.positions_mm.size(); ++i) {
            if (std::string(name) == "sphere" && (exact.uvs[i].y == 0 || exact.uvs[i].y == 1)) continue;
            const Vec4 a = mesh.tangents[i], b = exact.tangents[i];
            EXPECT_GT(dot(Vec3{a.x, a.y, a.z}, Vec3{b.x, b.y, b.z}), 0.99f);
            EXPECT_EQ(a.w, b.w);
        }
    }
}

TEST(Primitives, lie_where_their_headers_say) {
    for (const Vec3& p : make_sphere(10).positions_mm) EXPECT_NEAR(length(p), 10, 1e-4);
    const Mesh sphere = make_sphere(10, 8);
    const auto at = [&](Vec2 uv) {
        return sphere.positions_mm[size_t(std::ranges::find(sphere.uvs, uv) - sphere.uvs.begin())];
    };
    EXPECT_NEAR(at({0.5f, 0.5f}).z, 10, 1e-4) << "the front";
    EXPECT_NEAR(at({0.75f, 0.5f}).x, 10, 1e-4) << "the right as seen from the front";
    for (const Vec3& p : make_torus(20, 6).positions_mm)
        EXPECT_NEAR(std::hypot(std::hypot(p.x, p.z) - 20, p.y), 6, 1e-4);
    const Mesh plane = make_plane(10, 20);
    EXPECT_EQ(plane.positions_mm[0], (Vec3{-5, 10, 0})) << "the UV origin is top-left";
}
