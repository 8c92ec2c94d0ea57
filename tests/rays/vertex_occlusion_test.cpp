#include "dermis/rays/vertex_occlusion.h"

#include <gtest/gtest.h>

#include "dermis/base/parallel.h"
#include "reference/shapes.h"

namespace dermis {
namespace {

constexpr OcclusionSettings kFresh{.use_cache = false};

TEST(VertexOcclusion, a_convex_body_is_open_everywhere) {
    const auto values = compute_vertex_occlusion(test::sphere(50, 3), kFresh);
    ASSERT_TRUE(values);
    for (const float value : *values) EXPECT_EQ(value, 1.0f);
}

TEST(VertexOcclusion, the_foot_of_a_wall_sees_half_the_sky) {
    // A floor with a very tall and wide wall along x = 0: at distance a the visible share is (1 + sin(angle))
    // / 2, the angle being between the vertical and the edge of the wall; near the foot that is one half.
    Mesh floor = test::plane(20, 0, 10);
    Mesh wall = test::grid(1, 1, [](float u, float v) {
        return test::Placed{{0, (u - 0.5f) * 20000, (1 - v) * 10000}, {1, 0, 0}};
    });
    const auto values =
        compute_vertex_occlusion(test::joined(floor, wall), {.rays = 1024, .use_cache = false});
    ASSERT_TRUE(values);
    for (size_t i = 0; i < floor.positions_mm.size(); ++i)
        if (std::abs(floor.positions_mm[i].x) > 1) {
            EXPECT_NEAR((*values)[i], 0.5f, 0.01f) << i;
        }
}

TEST(VertexOcclusion, a_disk_overhead_takes_the_square_of_its_sine) {
    // A disk of radius h above the point at height h fills the cone of 45 degrees: sin^2 = 1/2 of the
    // cosine-weighted sky.
    Mesh disk = test::grid(64, 1, [](float u, float v) {
        const float angle = 2 * std::numbers::pi_v<float> * u;
        return test::Placed{{5 * (1 - v) * std::cos(angle), 5 * (1 - v) * std::sin(angle), 5}, {0, 0, -1}};
    });
    const Mesh floor = test::plane(0.01f, 0);
    const auto values =
        compute_vertex_occlusion(test::joined(floor, disk), {.rays = 4096, .use_cache = false});
    ASSERT_TRUE(values);
    EXPECT_NEAR((*values)[0], 0.5f, 0.004f);
}

TEST(VertexOcclusion, beyond_the_maximum_distance_nothing_occludes) {
    const Mesh room = test::joined(test::plane(1, 0), test::plane(1000, 10));
    EXPECT_LT((*compute_vertex_occlusion(room, kFresh))[0], 0.05f);
    EXPECT_EQ((*compute_vertex_occlusion(room, {.max_mm = 9, .use_cache = false}))[0], 1.0f);
}

TEST(VertexOcclusion, the_thread_count_and_a_uv_seam_change_nothing) {
    Mesh bowl = test::uv_sphere(20, 24, 12);
    for (Vec3& n : bowl.normals) n = n + Vec3{0.3f, 0, 0};
    for (Vec3& n : bowl.normals) n = normalize(n);
    const auto all = compute_vertex_occlusion(bowl, kFresh);
    set_thread_limit(1);
    const auto one = compute_vertex_occlusion(bowl, kFresh);
    set_thread_limit(0);
    EXPECT_EQ(*all, *one);
    // A copy of every vertex with another uv is the same point to the sky.
    Mesh doubled = bowl;
    doubled.positions_mm.insert(doubled.positions_mm.end(), bowl.positions_mm.begin(),
                                bowl.positions_mm.end());
    doubled.normals.insert(doubled.normals.end(), bowl.normals.begin(), bowl.normals.end());
    doubled.uvs.insert(doubled.uvs.end(), bowl.uvs.size(), Vec2{0.7f, 0.1f});
    const auto twice = compute_vertex_occlusion(doubled, kFresh);
    for (size_t i = 0; i < bowl.positions_mm.size(); ++i) EXPECT_EQ((*twice)[i], (*twice)[i + all->size()]);
}

TEST(VertexOcclusion, objects_of_a_scene_occlude_each_other_but_glass_does_not) {
    std::vector<SceneObject> objects(2);
    objects[0] = {.name = "floor", .mesh = test::plane(1, 0), .classes = {MaterialClass::skin}};
    objects[1] = {.name = "lid", .mesh = test::plane(1000, 10), .classes = {MaterialClass::other}};
    EXPECT_LT((*compute_vertex_occlusion(objects, kFresh))[0][0], 0.05f);
    objects[1].classes = {MaterialClass::translucent};
    EXPECT_EQ((*compute_vertex_occlusion(objects, kFresh))[0][0], 1.0f);
}

TEST(VertexOcclusion, absurd_ray_counts_are_refused) {
    for (const int rays : {0, -1, 65537})
        EXPECT_FALSE(compute_vertex_occlusion(test::plane(1, 0), {.rays = rays}));
}

}  // namespace
}  // namespace dermis
