// Cameras: their matrices for Vulkan's clip space, in which y points down.

#include <algorithm>
#include <cmath>

#include "dermis/scene/projection.h"
#include "dermis/scene/scene.h"

namespace dermis::inline scene {
namespace {

// Where the view is along `up`, the roll is undefined: then the world axis farthest from the view replaces
// it.
Vec3 usable_up(Vec3 forward, Vec3 up) {
    if (length(cross(forward, normalize(up))) > 1e-4f) return up;
    return std::abs(forward.z) < 0.7f ? Vec3{0, 0, -1} : Vec3{0, 1, 0};
}

}  // namespace

CameraMatrices camera_matrices(const Camera& camera, float aspect) {
    Vec3 forward = normalize(camera.target_mm - camera.eye_mm);
    if (length(forward) == 0) forward = {0, 0, -1};
    const Mat4 view = look_along(camera.eye_mm, forward, usable_up(forward, camera.up_world));
    Mat4 projection = perspective(camera.vertical_fov_rad, aspect, camera.near_mm, camera.far_mm);
    projection.m[5] = -projection.m[5];
    return {.view = view,
            .projection = projection,
            .view_projection = projection * view,
            .inverse_view_projection = inverse_view(view) * inverse_perspective(projection)};
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
    // An arcsine would lose half of the digits near the poles.
    return {.yaw_rad = std::atan2(direction.x, direction.z),
            .pitch_rad = std::atan2(direction.y, std::hypot(direction.x, direction.z))};
}

}  // namespace dermis::inline scene
