#include "dermis/view/orbit.h"

#include <gtest/gtest.h>

namespace dermis::view {
namespace {

constexpr float kHeight = 600;

Vec2 on_screen(const Camera& camera, Vec3 p_world_mm) {
    const Mat4& m = camera_matrices(camera, 1).view_projection;
    const auto row = [&](int r) {
        return m.m[r] * p_world_mm.x + m.m[4 + r] * p_world_mm.y + m.m[8 + r] * p_world_mm.z + m.m[12 + r];
    };
    return {(row(0) / row(3) + 1) / 2 * kHeight, (row(1) / row(3) + 1) / 2 * kHeight};
}

Scene a_scene() {
    Scene scene;
    scene.bounds_center_mm = {10, 20, 30};
    scene.bounds_radius_mm = 120;
    scene.lights = {{.name = "key", .is_key = true}};
    return scene;
}

TEST(Orbit, what_faces_the_eye_follows_the_mouse_and_the_distance_stays) {
    Camera camera;
    const Vec3 nose_mm = {0, 0, 100};
    const Vec2 before = on_screen(camera, nose_mm);
    orbit(camera, {30, 20}, kHeight);
    const Vec2 after = on_screen(camera, nose_mm);
    EXPECT_GT(after.x, before.x + 5);
    EXPECT_GT(after.y, before.y + 5);
    EXPECT_NEAR(length(camera.eye_mm - camera.target_mm), 600, 1e-2);
}

TEST(Orbit, stops_short_of_the_poles) {
    Camera camera;
    for (int i = 0; i < 50; ++i) orbit(camera, {0, 100}, kHeight);
    EXPECT_GT(camera.eye_mm.y, 590);
    EXPECT_GT(length(cross(normalize(camera.eye_mm), camera.up_world)), 0.01f);
}

TEST(Pan, the_target_follows_the_mouse_exactly) {
    Camera camera{.eye_mm = {200, 150, 500}};
    const Vec3 point_mm = camera.target_mm;
    const Vec2 before = on_screen(camera, point_mm);
    pan(camera, {37, -21}, kHeight);
    const Vec2 after = on_screen(camera, point_mm);
    EXPECT_NEAR(after.x - before.x, 37, 0.05);
    EXPECT_NEAR(after.y - before.y, -21, 0.05);
}

TEST(Zoom, keeps_its_limits_and_its_direction) {
    Camera camera;
    zoom(camera, 1, 120);
    EXPECT_NEAR(camera.eye_mm.z, 540, 1e-2);
    zoom(camera, 1000, 120);
    EXPECT_NEAR(camera.eye_mm.z, 1.2, 1e-3);
    zoom(camera, -1000, 120);
    EXPECT_NEAR(camera.eye_mm.z, 6000, 1e-1);
}

TEST(Fit, the_bounding_sphere_touches_the_narrower_sides) {
    const Scene scene = a_scene();
    for (const float aspect : {1.0f, 2.0f, 0.5f}) {
        Camera camera{.eye_mm = {500, 100, 900}};
        fit(camera, scene, aspect);
        const float distance_mm = length(camera.eye_mm - scene.bounds_center_mm);
        const float narrow_rad = std::atan(std::tan(camera.vertical_fov_rad / 2) * std::min(1.0f, aspect));
        EXPECT_NEAR(std::asin(scene.bounds_radius_mm / distance_mm) / narrow_rad, 0.98, 0.01) << aspect;
    }
}

TEST(KeyLight, follows_the_mouse_to_the_right_and_upwards) {
    Scene scene = a_scene();
    turn_key_light(scene, {50, -50}, kHeight);
    EXPECT_GT(scene.lights[0].to_light_world.x, 0.1f);
    EXPECT_GT(scene.lights[0].to_light_world.y, 0.1f);
    scene.lights[0].kind = LightKind::point;
    scene.lights[0].position_mm = {10, 20, 1030};
    turn_key_light(scene, {50, 0}, kHeight);
    EXPECT_GT(scene.lights[0].position_mm.x, 100);
    EXPECT_NEAR(length(scene.lights[0].position_mm - scene.bounds_center_mm), 1000, 0.1);
}

}  // namespace
}  // namespace dermis::view
