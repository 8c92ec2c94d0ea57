#include "dermis/rays/flesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dermis/mesh/hole_caps.h"
#include "reference/shapes.h"

namespace dermis {
namespace {

SceneObject skin(Mesh mesh) {
    return {.name = "skin", .mesh = std::move(mesh), .classes = {MaterialClass::skin}};
}

Flesh flesh_of(const SceneObject& object, Cavities cavities = Cavities::flesh) {
    auto all = find_flesh(std::span(&object, 1), cavities);
    EXPECT_TRUE(all) << all.error().message;
    return std::move((*all)[0]);
}

// Triangles whose middle the condition holds for are dropped.
template <class Condition>
Mesh without(Mesh mesh, Condition condition) {
    std::vector<uint32_t> kept;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const uint32_t* c = &mesh.indices[i];
        const Vec3 middle =
            (mesh.positions_mm[c[0]] + mesh.positions_mm[c[1]] + mesh.positions_mm[c[2]]) * (1.0f / 3);
        if (!condition(middle)) kept.insert(kept.end(), c, c + 3);
    }
    mesh.indices = kept;
    mesh.submeshes[0].index_count = uint32_t(kept.size());
    return mesh;
}

TEST(Flesh, a_closed_body_hides_nothing_and_has_no_opening) {
    const Flesh flesh = flesh_of(skin(test::sphere(20, 3)));
    EXPECT_EQ(flesh.hidden_triangles, 0u);
    EXPECT_EQ(flesh.mesh_openings, 0u);
    EXPECT_TRUE(flesh.caps.empty());
    EXPECT_NEAR(flesh.skin_area_mm2, 4 * M_PI * 400, 0.02 * 4 * M_PI * 400);
}

TEST(Flesh, the_inside_of_a_shell_is_hidden_and_its_outside_is_not) {
    const Mesh outer = test::sphere(20, 3), inner = test::inside_out(test::sphere(12, 2));
    const SceneObject object = skin(test::joined(outer, inner));
    const Flesh flesh = flesh_of(object);
    EXPECT_EQ(flesh.hidden_triangles, inner.triangle_count());
    EXPECT_NEAR(flesh.hidden_area_mm2, 4 * M_PI * 144, 0.04 * 4 * M_PI * 144);
    for (size_t t = 0; t < outer.triangle_count(); ++t) EXPECT_EQ(flesh.faces[t], SkinFace::visible) << t;
    EXPECT_EQ(flesh_of(object, Cavities::open).hidden_triangles, 0u);
}

TEST(Flesh, a_cavity_with_a_narrow_opening_is_hidden_up_to_the_opening_and_closed_there) {
    // A vase: walls 2 mm apart, a mouth of 1 mm radius, 20 mm deep.
    const float outer_mm = 20, inner_mm = 18;
    const Mesh vase = test::inside_out(test::grid(48, 96, [&](float u, float v) {
        const float azimuth = test::turn_rad(u), mouth = 0.05f, pi = std::numbers::pi_v<float>;
        const bool outside = v < 0.5f;
        const float polar = pi - (pi - mouth) * (outside ? 2 * v : 2 - 2 * v);
        const float sine = v == 0 || v == 1 ? 0 : std::sin(polar);
        const Vec3 n{sine * std::sin(azimuth), std::cos(polar), sine * std::cos(azimuth)};
        return test::Placed{n * (outside ? outer_mm : inner_mm), outside ? -n : n};
    }));
    const SceneObject object = skin(vase);
    const Flesh flesh = flesh_of(object);
    const double inside = 4 * M_PI * inner_mm * inner_mm, outside = 4 * M_PI * outer_mm * outer_mm;
    EXPECT_NEAR(flesh.hidden_area_mm2, inside, 0.02 * inside);
    EXPECT_NEAR(flesh.skin_area_mm2, inside + outside, 0.02 * inside);
    EXPECT_EQ(flesh.mesh_openings, 0u);
    EXPECT_FALSE(flesh.caps.empty());
    // The hidden part has one border: one loop of the ring's 48 vertices.
    std::vector<uint32_t> visible;
    for (uint32_t t = 0; t < flesh.faces.size(); ++t)
        if (flesh.faces[t] == SkinFace::visible) visible.push_back(t);
    EXPECT_EQ(border_loops(object.mesh.positions_mm, object.mesh.indices, visible).size(), 1u);
    EXPECT_EQ(flesh.caps.size(), 46u);
    EXPECT_EQ(flesh.cavity_caps, 46u);
}

TEST(Flesh, an_open_bowl_and_a_crease_are_skin) {
    // Half a sphere from within, and two spheres that overlap: both see much of the outside.
    Mesh bowl = without(test::inside_out(test::sphere(20, 3)), [](Vec3 p) { return p.y > 0; });
    EXPECT_EQ(flesh_of(skin(bowl)).hidden_triangles, 0u);
    Mesh other = test::sphere(20, 4);
    for (Vec3& p : other.positions_mm) p.x += 39;
    const Flesh pair = flesh_of(skin(test::joined(test::sphere(20, 4), other)));
    EXPECT_LT(pair.hidden_area_mm2,
              2 * M_PI * 20 * 2);  // of the two caps inside the other sphere, 0.5 mm high
}

TEST(Flesh, what_lies_in_another_part_s_flesh_is_buried_and_leaves_no_opening) {
    Mesh part = test::sphere(10, 3);
    for (Vec3& p : part.positions_mm) p.z += 18;
    const Mesh body = test::sphere(20, 4);
    const Flesh flesh = flesh_of(skin(test::joined(body, part)));
    EXPECT_GT(flesh.hidden_triangles, 100u);
    EXPECT_TRUE(flesh.caps.empty());
    for (size_t t = 0; t < flesh.faces.size(); ++t) EXPECT_NE(flesh.faces[t], SkinFace::cavity) << t;
}

TEST(Flesh, an_open_border_is_an_opening_with_a_cap) {
    const Mesh cut = without(test::sphere(20, 3), [](Vec3 p) { return p.y < -10; });
    const Flesh flesh = flesh_of(skin(cut));
    EXPECT_EQ(flesh.mesh_openings, 1u);
    EXPECT_EQ(flesh.hidden_triangles, 0u);
    EXPECT_EQ(flesh.cavity_caps, 0u);
    Vec3 facing;
    for (const auto& [a, b, c] : flesh.caps) facing += cross(b - a, c - a) * 0.5f;
    EXPECT_LT(facing.y, -0.9 * M_PI * 300);
}

TEST(Flesh, a_sheet_is_the_front_of_a_body) {
    const Mesh plane = test::grid(4, 4, [](float u, float v) {
        return std::pair(Vec3{10 * u, -10 * v, 0}, Vec3{0, 0, 1});
    });
    const Flesh flesh = flesh_of(skin(plane));
    double volume_mm3 = 0, lowest_mm = 0;
    for (const auto& [a, b, c] : flesh.caps) {
        volume_mm3 += double(dot(a, cross(b, c))) / 6;  // the plane itself is at z = 0
        lowest_mm = std::min({lowest_mm, double(a.z), double(b.z), double(c.z)});
    }
    EXPECT_NEAR(volume_mm3, 100 * kSheetDepthMm, 1) << "caps face out and leave no hole";
    EXPECT_NEAR(lowest_mm, -kSheetDepthMm, 1e-4);
    EXPECT_EQ(flesh.mesh_openings, 1u);
    EXPECT_TRUE(flesh.is_sheet);
}

TEST(Flesh, other_objects_and_translucent_surfaces_hide_nothing) {
    const Mesh shell = test::sphere(30, 2);
    const SceneObject objects[] = {skin(test::sphere(20, 2)), skin(shell)};
    const auto both = find_flesh(objects);
    ASSERT_TRUE(both);
    EXPECT_EQ((*both)[0].hidden_triangles, 0u);
    SceneObject glass = skin(test::joined(test::sphere(20, 2), shell));
    glass.classes = {MaterialClass::skin, MaterialClass::translucent};
    EXPECT_EQ(flesh_of(glass).hidden_triangles, 0u);
    glass.classes = {MaterialClass::skin, MaterialClass::other};
    EXPECT_EQ(flesh_of(glass).hidden_triangles, 0u);  // all of the skin: nothing would be left of it
}

TEST(Flesh, a_mesh_that_turns_the_wrong_way_keeps_its_skin) {
    EXPECT_EQ(flesh_of(skin(test::inside_out(test::sphere(20, 2)))).hidden_triangles, 0u);
}

}  // namespace
}  // namespace dermis
