#include "dermis/rays/ray_scene.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "reference/shapes.h"

namespace dermis {
namespace {

SceneObject object_of(Mesh mesh, std::vector<MaterialClass> classes) {
    return {.name = "object", .mesh = std::move(mesh), .classes = std::move(classes)};
}

TEST(RayScene, a_ray_meets_the_near_side_of_a_sphere_and_reads_its_attributes) {
    const Mesh sphere = test::sphere(10, 5);
    const Result<RayScene> scene = RayScene::build(sphere);
    ASSERT_TRUE(scene);
    const auto hit = scene->closest_hit(RaySet::skin, {.origin_mm = {1, 2, 50}, .direction = {0, 0, -1}});
    ASSERT_TRUE(hit);
    const float z = std::sqrt(100.0f - 5.0f);
    EXPECT_NEAR(hit->distance_mm, 50 - z, 5e-3);
    const SurfaceAttributes surface = scene->surface_at(*hit);
    EXPECT_NEAR(surface.n_geometry_world.x, 0.1f, 1e-3);
    EXPECT_NEAR(surface.n_geometry_world.y, 0.2f, 1e-3);
    EXPECT_GT(dot(surface.n_face_world, surface.n_geometry_world), 0.999f);
    EXPECT_NEAR(length(surface.p_world_mm - Vec3{1, 2, z}), 0, 5e-3);
    EXPECT_FALSE(scene->closest_hit(RaySet::skin, {.origin_mm = {11, 0, 50}, .direction = {0, 0, -1}}));
}

TEST(RayScene, the_smooth_point_lies_closer_to_the_sphere_than_the_facet) {
    const Mesh sphere = test::sphere(10, 1);
    const Result<RayScene> scene = RayScene::build(sphere);
    const auto hit =
        scene->closest_hit(RaySet::skin, {.origin_mm = {0.7f, 1.3f, 50}, .direction = {0, 0, -1}});
    const SurfaceAttributes surface = scene->surface_at(*hit);
    const float facet_gap = 10 - length(surface.p_world_mm), smooth_gap = length(surface.p_smooth_mm) - 10;
    EXPECT_GT(facet_gap, 0.05f);
    EXPECT_GT(smooth_gap, -0.02f);
    EXPECT_LT(smooth_gap, facet_gap * 1.5f);
}

TEST(RayScene, all_hits_of_a_line_through_nested_spheres_are_found_once_each) {
    const Mesh nested =
        test::joined(test::joined(test::sphere(10, 3), test::sphere(6, 3)), test::sphere(3, 3));
    const Result<RayScene> scene = RayScene::build(nested);
    const Ray ray{.origin_mm = {0.1f, 0.2f, 20}, .direction = {0, 0, -1}, .max_mm = 40};
    RayHit hits[16];
    ASSERT_EQ(scene->all_hits(RaySet::skin, ray, hits), 6u);
    std::sort(hits, hits + 6, [](const RayHit& a, const RayHit& b) { return a.distance_mm < b.distance_mm; });
    const float expected[] = {10, 14, 17, 23, 26, 30};
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(hits[i].distance_mm, expected[i], 0.15f) << i;
    EXPECT_EQ(scene->all_hits(RaySet::skin, ray, std::span(hits, 2)), 2u);
}

TEST(RayScene, each_set_sees_its_own_materials) {
    Mesh mesh = test::joined(test::joined(test::plane(10, 0), test::plane(10, 1)), test::plane(10, 2));
    const SceneObject object =
        object_of(mesh, {MaterialClass::skin, MaterialClass::other, MaterialClass::translucent});
    const Result<RayScene> scene = RayScene::build(std::span(&object, 1));
    ASSERT_TRUE(scene);
    const Ray down{.origin_mm = {1, 1, 10}, .direction = {0, 0, -1}};
    EXPECT_NEAR(scene->closest_hit(RaySet::translucent, down)->distance_mm, 8, 1e-4);
    EXPECT_NEAR(scene->closest_hit(RaySet::opaque, down)->distance_mm, 9, 1e-4);
    EXPECT_NEAR(scene->closest_hit(RaySet::skin, down)->distance_mm, 10, 1e-4);
    EXPECT_EQ(scene->surface_at(*scene->closest_hit(RaySet::opaque, down)).material, 1u);
    EXPECT_TRUE(scene->occluded(RaySet::skin, down));
    EXPECT_FALSE(
        scene->occluded(RaySet::skin, {.origin_mm = {1, 1, 10}, .direction = {0, 0, -1}, .max_mm = 9.9f}));
}

TEST(RayScene, a_scene_without_triangles_is_an_error) {
    EXPECT_FALSE(RayScene::build(Mesh{}));
    EXPECT_FALSE(RayScene::build(std::span<const SceneObject>{}));
}

}  // namespace
}  // namespace dermis
