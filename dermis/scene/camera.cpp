// Camera matrices for Vulkan's clip space: glm's right-handed, zero-to-one projection with y turned down.

#include <algorithm>
#include <cmath>
#define GLM_FORCE_DEPTH_ZERO_TO_ONE
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "dermis/scene/scene.h"

namespace dermis {
namespace {

glm::vec3 to_glm(Vec3 v) {
    return {v.x, v.y, v.z};
}

Mat4 from_glm(const glm::mat4& matrix) {
    Mat4 result;
    std::copy_n(glm::value_ptr(matrix), 16, result.m);
    return result;
}

// Looking along `up` leaves the roll open: then the world axis that is farthest from the view stands in.
glm::vec3 usable_up(Vec3 forward, Vec3 up) {
    if (length(cross(forward, normalize(up))) > 1e-4f) return to_glm(up);
    return std::abs(forward.z) < 0.7f ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
}

}  // namespace

CameraMatrices camera_matrices(const Camera& camera, float aspect) {
    Vec3 forward = normalize(camera.target_mm - camera.eye_mm);
    if (length(forward) == 0) forward = {0, 0, -1};
    const glm::vec3 eye = to_glm(camera.eye_mm);
    const glm::mat4 view = glm::lookAtRH(eye, eye + to_glm(forward), usable_up(forward, camera.up_world));
    glm::mat4 projection =
        glm::perspectiveRH_ZO(camera.vertical_fov_rad, aspect, camera.near_mm, camera.far_mm);
    projection[1][1] = -projection[1][1];
    const glm::mat4 view_projection = projection * view;
    return {.view = from_glm(view),
            .projection = from_glm(projection),
            .view_projection = from_glm(view_projection),
            .inverse_view_projection = from_glm(glm::inverse(view_projection))};
}

void fit_depth_range(Camera& camera, Vec3 center_mm, float radius_mm) {
    const float distance_mm = length(center_mm - camera.eye_mm);
    camera.far_mm = (distance_mm + radius_mm) * 1.01f;
    camera.near_mm = std::max((distance_mm - radius_mm) * 0.99f, camera.far_mm * 1e-4f);
}

Camera framing_camera(Vec3 center_mm, float radius_mm, float fov_rad) {
    Camera camera{.target_mm = center_mm, .vertical_fov_rad = fov_rad};
    const float distance_mm = 1.05f * radius_mm / std::sin(fov_rad / 2);
    camera.eye_mm = center_mm + Vec3{0, 0, distance_mm};
    fit_depth_range(camera, center_mm, radius_mm);
    return camera;
}

Vec3 direction_from_yaw_pitch(float yaw_rad, float pitch_rad) {
    return {std::sin(yaw_rad) * std::cos(pitch_rad), std::sin(pitch_rad),
            std::cos(yaw_rad) * std::cos(pitch_rad)};
}

YawPitch yaw_pitch_of(Vec3 direction) {
    const Vec3 d = normalize(direction);
    return {.yaw_rad = std::atan2(d.x, d.z), .pitch_rad = std::asin(std::clamp(d.y, -1.0f, 1.0f))};
}

}  // namespace dermis
