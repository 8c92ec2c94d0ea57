#include "dermis/view/orbit.h"

#include <algorithm>

#include "dermis/base/angle.h"

namespace dermis::view {
namespace {

constexpr float kMaxPitchRad = 0.495f * kPi;

YawPitch turned(YawPitch angles, Vec2 drag_px, float height_px) {
    const float rad_per_px = kPi / std::max(height_px, 1.0f);
    angles.yaw_rad += drag_px.x * rad_per_px;
    angles.pitch_rad = std::clamp(angles.pitch_rad + drag_px.y * rad_per_px, -kMaxPitchRad, kMaxPitchRad);
    return angles;
}

Vec3 direction(YawPitch angles) {
    return direction_from_yaw_pitch(angles.yaw_rad, angles.pitch_rad);
}

}  // namespace

void orbit(Camera& camera, Vec2 drag_px, float height_px) {
    const Vec3 to_eye = camera.eye_mm - camera.target_mm;
    const Vec2 eye_drag_px = {-drag_px.x,
                              drag_px.y};  // the head follows the mouse, so the eye moves the other way
    camera.eye_mm =
        camera.target_mm + direction(turned(yaw_pitch_of(to_eye), eye_drag_px, height_px)) * length(to_eye);
}

void pan(Camera& camera, Vec2 drag_px, float height_px) {
    const Vec3 to_eye = camera.eye_mm - camera.target_mm;
    const Vec3 back = normalize(to_eye);
    const Vec3 right = normalize(cross(camera.up_world, back));
    const Vec3 up = cross(back, right);
    const float mm_per_px =
        2 * std::tan(camera.vertical_fov_rad / 2) * length(to_eye) / std::max(height_px, 1.0f);
    const Vec3 shift = (up * drag_px.y - right * drag_px.x) * mm_per_px;
    camera.eye_mm += shift;
    camera.target_mm += shift;
}

void zoom(Camera& camera, float notches, float radius_mm) {
    const Vec3 to_eye = camera.eye_mm - camera.target_mm;
    const float distance_mm =
        std::clamp(length(to_eye) * std::pow(0.9f, notches), radius_mm * 0.01f, radius_mm * 50);
    camera.eye_mm = camera.target_mm + normalize(to_eye) * distance_mm;
}

void fit(Camera& camera, const Scene& scene, float aspect) {
    const float half_fov_rad = camera.vertical_fov_rad / 2;
    const float narrow_rad = std::min(half_fov_rad, std::atan(std::tan(half_fov_rad) * aspect));
    const Vec3 back = normalize(camera.eye_mm - camera.target_mm);
    camera.target_mm = scene.bounds_center_mm;
    camera.eye_mm = camera.target_mm + back * (1.02f * scene.bounds_radius_mm / std::sin(narrow_rad));
}

void turn_key_light(Scene& scene, Vec2 drag_px, float height_px) {
    const auto key = std::ranges::find(scene.lights, true, &Light::is_key);
    if (key == scene.lights.end()) return;
    const Vec3 center_mm = scene.bounds_center_mm;
    const bool directional = key->kind == LightKind::directional;
    const Vec3 to_light = directional ? key->to_light_world : key->position_mm - center_mm;
    const Vec2 light_drag_px = {drag_px.x, -drag_px.y};
    const Vec3 turned_to = direction(turned(yaw_pitch_of(to_light), light_drag_px, height_px));
    key->to_light_world = turned_to;
    if (!directional) key->position_mm = center_mm + turned_to * length(to_light);
}

}  // namespace dermis::view
