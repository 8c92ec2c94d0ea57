#include "dermis/render/frame_values.h"

#include <algorithm>
#include <cmath>
#define GLM_FORCE_DEPTH_ZERO_TO_ONE
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "shaders/include/constants.h"

namespace dermis {
namespace {

glm::vec3 to_glm(Vec3 v) {
    return {v.x, v.y, v.z};
}

Mat4 from_glm(const glm::mat4& matrix) {
    Mat4 result;
    std::copy_n(&matrix[0][0], 16, result.m);
    return result;
}

// Any direction that is not along `d`.
glm::vec3 up_for(glm::vec3 d) {
    return std::abs(d.y) < 0.99f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
}

// The first light that is the key, or is not; -1: none.
int light_index(const Scene& scene, bool is_key) {
    const auto found = std::ranges::find(scene.lights, is_key, &Light::is_key);
    return found == scene.lights.end() ? -1 : int(found - scene.lights.begin());
}

Mat4 light_matrix_of(const Scene& scene, int light) {
    if (light < 0) return {};
    return light_matrix(scene.lights[size_t(light)], scene.bounds_center_mm, scene.bounds_radius_mm);
}

}  // namespace

Mat4 light_matrix(const Light& light, Vec3 center_mm, float radius_mm) {
    const glm::vec3 center = to_glm(center_mm);
    if (light.kind == LightKind::directional) {
        const glm::vec3 direction = to_glm(light.to_light_world);
        const glm::mat4 view = glm::lookAt(center + direction * (2 * radius_mm), center, up_for(direction));
        const float r = radius_mm;
        return from_glm(glm::ortho(-r, r, -r, r, radius_mm, 3 * radius_mm) * view);
    }
    const glm::vec3 eye = to_glm(light.position_mm);
    const float distance_mm = std::max(glm::length(eye - center), 1e-3f);
    const glm::vec3 direction = (eye - center) / distance_mm;
    const glm::mat4 view = glm::lookAt(eye, center, up_for(direction));
    // The cone that touches the sphere; a light inside it sees at most 150 degrees.
    const float sine = std::min(radius_mm / distance_mm, 0.966f);
    const float near_mm = std::max(distance_mm - radius_mm, 0.01f * distance_mm);
    return from_glm(glm::perspective(2 * std::asin(sine), 1.0f, near_mm, distance_mm + radius_mm) * view);
}

static_assert(int(LightKind::directional) == kLightDirectional && int(LightKind::point) == kLightPoint &&
              int(LightKind::spot) == kLightSpot);

std::vector<gpu::Values> light_values(const Scene& scene) {
    std::vector<gpu::Values> lights;
    const std::vector<int> maps = scene.shadow_maps();
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        lights.push_back({{"kind", int32_t(light.kind)},
                          {"intensity_linear", light.color_linear * light.intensity},
                          {"to_light_world", light.to_light_world},
                          {"position_mm", light.position_mm},
                          {"cos_inner", std::cos(light.inner_angle_rad)},
                          {"cos_outer", std::cos(light.outer_angle_rad)},
                          {"shadow_map_index", int32_t(maps[i])},
                          {"light_view_projection", light_matrix_of(scene, int(i))}});
    }
    if (lights.empty()) {
        lights.push_back({{"kind", int32_t(kLightDirectional)},
                          {"intensity_linear", Vec3{}},
                          {"to_light_world", Vec3{0, 0, 1}},
                          {"position_mm", Vec3{}},
                          {"cos_inner", 1.0f},
                          {"cos_outer", 0.0f},
                          {"shadow_map_index", int32_t(-1)},
                          {"light_view_projection", Mat4{}}});
    }
    return lights;
}

gpu::Values frame_values(const Scene& scene, const FrameValueSettings& settings) {
    const CameraMatrices camera =
        camera_matrices(scene.camera, float(settings.width) / float(settings.height));
    const int key = light_index(scene, true), second = light_index(scene, false);
    return {{"view_projection", camera.view_projection},
            {"inverse_view_projection", camera.inverse_view_projection},
            {"light_view_projection", light_matrix_of(scene, key)},
            {"eye_world_mm", scene.camera.eye_mm},
            {"bounds_center_mm", scene.bounds_center_mm},
            {"bounds_radius_mm", scene.bounds_radius_mm},
            {"background_linear", scene.background_linear},
            {"environment_visible",
             int32_t(scene.environment.visible && scene.environment.kind != EnvironmentKind::none)},
            {"environment_intensity",
             scene.environment.kind == EnvironmentKind::none ? 0.0f : scene.environment.intensity},
            {"environment_yaw_rad", scene.environment.yaw_rad},
            {"environment_mip_count", float(settings.environment_mip_count)},
            {"light_count", int32_t(scene.lights.size())},
            {"key_light", int32_t(key)},
            {"shadow_texel_mm", 2 * scene.bounds_radius_mm / float(settings.shadow_map_size)},
            {"penumbra_mm", settings.penumbra_mm},
            {"exposure", std::exp2(scene.exposure_ev)},
            {"second_light", int32_t(second)},
            {"second_light_view_projection", light_matrix_of(scene, second)}};
}

}  // namespace dermis
