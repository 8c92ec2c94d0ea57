#include <gtest/gtest.h>

#include <cmath>

#include "dermis/scene/scene_words.h"

using namespace dermis;

namespace {

struct ClipPoint {
    float x, y, z;
};

ClipPoint project(const Mat4& matrix, Vec3 p) {
    const auto row = [&](int r) {
        return matrix.m[r] * p.x + matrix.m[4 + r] * p.y + matrix.m[8 + r] * p.z + matrix.m[12 + r];
    };
    return {row(0) / row(3), row(1) / row(3), row(2) / row(3)};
}

Camera camera_with(const char* text, const Camera& camera = {}) {
    Scene scene{.camera = camera};
    const Result<void> set = set_section(scene, "camera", text);
    EXPECT_TRUE(set) << set.error().message;
    return scene.camera;
}

Light light_with(const char* text, const Light& light, Vec3 target_mm = {}) {
    Scene scene{.lights = {light}, .bounds_center_mm = target_mm};
    scene.lights[0].is_key = true;
    const Result<void> set = set_section(scene, "light.key", text);
    EXPECT_TRUE(set) << set.error().message;
    return scene.lights[0];
}

}  // namespace

TEST(Camera, projects_right_to_plus_x_and_up_to_minus_y_with_depth_from_zero_to_one) {
    const Camera camera{.eye_mm = {0, 0, 600}, .near_mm = 100, .far_mm = 1100};
    const Mat4 m = camera_matrices(camera, 1).view_projection;
    EXPECT_NEAR(project(m, {0, 0, 0}).x, 0, 1e-6);
    EXPECT_GT(project(m, {50, 0, 0}).x, 0.1f);
    EXPECT_LT(project(m, {0, 50, 0}).y, -0.1f);
    EXPECT_NEAR(project(m, {0, 0, 500}).z, 0, 1e-5);
    EXPECT_NEAR(project(m, {0, 0, -500}).z, 1, 1e-5);
}

TEST(Camera, the_field_of_view_is_vertical_and_the_aspect_widens) {
    const Camera camera{.eye_mm = {0, 0, 600}, .vertical_fov_rad = 0.6f};
    const float half_height_mm = 600 * std::tan(0.3f);
    EXPECT_NEAR(project(camera_matrices(camera, 2).view_projection, {0, half_height_mm, 0}).y, -1, 1e-4);
    EXPECT_NEAR(project(camera_matrices(camera, 2).view_projection, {2 * half_height_mm, 0, 0}).x, 1, 1e-4);
}

TEST(Camera, the_inverse_takes_clip_space_back_to_the_world) {
    const Camera camera{.eye_mm = {100, 50, 600}, .target_mm = {0, 20, 0}};
    const CameraMatrices m = camera_matrices(camera, 1.5f);
    const ClipPoint clip = project(m.view_projection, {30, -20, 10});
    const ClipPoint back = project(m.inverse_view_projection, {clip.x, clip.y, clip.z});
    EXPECT_NEAR(back.x, 30, 0.05);
    EXPECT_NEAR(back.y, -20, 0.05);
    EXPECT_NEAR(back.z, 10, 0.5);
}

TEST(Camera, looking_straight_down_or_at_itself_stays_finite) {
    for (const Camera& camera : {Camera{.eye_mm = {0, 500, 0}}, Camera{.eye_mm = {0, 0, 0}}})
        for (const float value : camera_matrices(camera, 1).inverse_view_projection.m)
            EXPECT_TRUE(std::isfinite(value));
}

TEST(Camera, a_framed_sphere_fills_the_height_and_lies_between_near_and_far) {
    const Camera camera = framing_camera({5, 6, 7}, 40);
    const Mat4 m = camera_matrices(camera, 1).view_projection;
    EXPECT_LT(project(m, {5, 46, 7}).y, -0.85f);
    EXPECT_GT(project(m, {5, 46, 7}).y, -1);
    EXPECT_GT(project(m, {5, 6, 47}).z, 0);
    EXPECT_LT(project(m, {5, 6, -33}).z, 1);
}

TEST(Camera, the_depth_range_follows_the_eye_even_into_the_sphere) {
    Camera camera{.eye_mm = {0, 0, 10}};
    fit_depth_range(camera, {0, 0, 0}, 40);
    EXPECT_GT(camera.near_mm, 0);
    EXPECT_GE(camera.far_mm, 50);
    camera.eye_mm = {0, 0, 20000};
    fit_depth_range(camera, {0, 0, 0}, 40);
    EXPECT_GT(camera.near_mm, 19000);
    EXPECT_GE(camera.far_mm, 20040);
}

TEST(CameraText, positive_yaw_moves_the_eye_towards_plus_x_and_positive_pitch_up) {
    const Camera camera = camera_with("yaw_deg=90 distance_mm=500");
    EXPECT_NEAR(camera.eye_mm.x, 500, 1e-3);
    EXPECT_NEAR(camera.eye_mm.z, 0, 1e-3);
    EXPECT_NEAR(camera_with("pitch_deg=30 distance_mm=500 target_mm=1,2,3").eye_mm.y, 252, 1e-3);
}

TEST(CameraText, keys_not_given_keep_what_the_camera_has) {
    const Camera before{.eye_mm = {10, 20, 300}, .target_mm = {1, 2, 3}, .vertical_fov_rad = 0.3f};
    const Camera untouched = camera_with("", before);
    EXPECT_EQ(untouched.eye_mm, before.eye_mm);
    EXPECT_EQ(untouched.vertical_fov_rad, before.vertical_fov_rad);
    const Camera closer = camera_with("distance_mm=100", before);
    EXPECT_NEAR(length(closer.eye_mm - before.target_mm), 100, 1e-3);
    EXPECT_NEAR(yaw_pitch_of(closer.eye_mm - before.target_mm).yaw_rad,
                yaw_pitch_of(before.eye_mm - before.target_mm).yaw_rad, 1e-5);
    const Camera moved = camera_with("eye_mm=0,0,50", before);
    EXPECT_EQ(moved.eye_mm, (Vec3{0, 0, 50}));
    EXPECT_EQ(moved.target_mm, before.target_mm);
}

TEST(CameraText, prints_what_parses_back_to_the_same_view) {
    const char* text = "yaw_deg=30 pitch_deg=5 distance_mm=600 fov_deg=25 target_mm=0,-12.5,3";
    EXPECT_EQ(camera_text(camera_with(text)), text);
}

TEST(LightText, a_directional_light_turns_and_takes_colour_and_intensity) {
    const Light light = light_with("yaw_deg=-90 intensity=2.5 color=1,.9,.8", Light{});
    EXPECT_NEAR(light.to_light_world.x, -1, 1e-6);
    EXPECT_EQ(light.intensity, 2.5f);
    EXPECT_EQ(light.color_linear, (Vec3{1, 0.9f, 0.8f}));
    EXPECT_EQ(light_text(light), "yaw_deg=-90 pitch_deg=0 intensity=2.5 color=1,0.9,0.8");
}

TEST(LightText, a_spot_light_moves_around_its_target_and_stays_aimed) {
    const Light spot{.kind = LightKind::spot, .position_mm = {0, 100, 500}};
    const Vec3 target = {0, 100, 0};
    const Light light = light_with("yaw_deg=90 distance_mm=200", spot, target);
    EXPECT_NEAR(light.position_mm.x, 200, 1e-3);
    EXPECT_NEAR(light.position_mm.y, 100, 1e-3);
    EXPECT_NEAR(light.to_light_world.x, 1, 1e-6);
    EXPECT_EQ(light_text(light, target),
              "yaw_deg=90 pitch_deg=0 intensity=3.1416 color=1,1,1 distance_mm=200");
}
