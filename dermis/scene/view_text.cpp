// Camera and light as texts: both live on a sphere around a target, at a yaw and a pitch.

#include <array>

#include "dermis/base/angle.h"
#include "dermis/scene/key_value_text.h"
#include "dermis/scene/scene.h"

namespace dermis {
namespace {

// The values of a text, in its own units; keys() ties names and ranges to them.
struct CameraWords {
    float yaw_deg = 0, pitch_deg = 0, distance_mm = 600, fov_deg = 30;
    Vec3 target_mm;

    explicit CameraWords(const Camera& camera) : target_mm(camera.target_mm) {
        const Vec3 to_eye = camera.eye_mm - camera.target_mm;
        const YawPitch angles = yaw_pitch_of(to_eye);
        yaw_deg = angles.yaw_rad * kDegreesPerRadian;
        pitch_deg = angles.pitch_rad * kDegreesPerRadian;
        distance_mm = length(to_eye);
        fov_deg = camera.vertical_fov_rad * kDegreesPerRadian;
    }
    std::array<TextKey, 5> keys() {
        return {TextKey{"yaw", "degrees, positive towards +X", -360, 360, &yaw_deg},
                TextKey{"pitch", "degrees, positive upwards", -90, 90, &pitch_deg},
                TextKey{"distance_mm", "mm", 0.1, 1e6, &distance_mm},
                TextKey{"fov_deg", "degrees, vertical", 1, 120, &fov_deg},
                TextKey{"target_mm", "mm", -1e6, 1e6, &target_mm.x, 3}};
    }
};

struct LightWords {
    float yaw_deg = 0, pitch_deg = 0, distance_mm = 0, intensity = 1;
    Vec3 color_linear;
    bool moved = false;

    LightWords(const Light& light, Vec3 target_mm)
        : intensity(light.intensity), color_linear(light.color_linear) {
        const Vec3 to_light =
            light.kind == LightKind::directional ? light.to_light_world : light.position_mm - target_mm;
        const YawPitch angles = yaw_pitch_of(to_light);
        yaw_deg = angles.yaw_rad * kDegreesPerRadian;
        pitch_deg = angles.pitch_rad * kDegreesPerRadian;
        distance_mm = length(light.position_mm - target_mm);
    }
    // A directional light has no distance, so its keys end before it.
    std::array<TextKey, 5> keys() {
        return {TextKey{"yaw", "degrees, positive towards +X", -360, 360, &yaw_deg, 1, &moved},
                TextKey{"pitch", "degrees, positive upwards", -90, 90, &pitch_deg, 1, &moved},
                TextKey{"intensity", "see Light::intensity", 0, 1e6, &intensity},
                TextKey{"color", "linear", 0, 1e3, &color_linear.x, 3},
                TextKey{"distance_mm", "mm", 0.1, 1e6, &distance_mm, 1, &moved}};
    }
};

std::span<const TextKey> keys_for(LightKind kind, const std::array<TextKey, 5>& keys) {
    return std::span(keys).first(kind == LightKind::directional ? keys.size() - 1 : keys.size());
}

}  // namespace

Result<Camera> parse_camera(std::string_view text, const Camera& camera) {
    CameraWords words(camera);
    bool orbit = false, fov = false;
    auto keys = words.keys();
    for (TextKey& key : keys) key.given = key.name == "fov_deg" ? &fov : &orbit;
    if (const Result<void> parsed = parse_key_values("camera", text, keys); !parsed) return parsed.error();
    Camera result = camera;
    if (fov) result.vertical_fov_rad = words.fov_deg / kDegreesPerRadian;
    if (orbit) {
        result.target_mm = words.target_mm;
        result.eye_mm = words.target_mm + direction_from_yaw_pitch(words.yaw_deg / kDegreesPerRadian,
                                                                   words.pitch_deg / kDegreesPerRadian) *
                                              words.distance_mm;
    }
    return result;
}

std::string camera_text(const Camera& camera) {
    CameraWords words(camera);
    return key_value_text(words.keys());
}

Result<Light> parse_light(std::string_view text, const Light& light, Vec3 target_mm) {
    LightWords words(light, target_mm);
    const auto keys = words.keys();
    if (const Result<void> parsed = parse_key_values("light", text, keys_for(light.kind, keys)); !parsed)
        return parsed.error();
    Light result = light;
    result.intensity = words.intensity;
    result.color_linear = words.color_linear;
    if (words.moved) {
        result.to_light_world =
            direction_from_yaw_pitch(words.yaw_deg / kDegreesPerRadian, words.pitch_deg / kDegreesPerRadian);
        if (light.kind != LightKind::directional)
            result.position_mm = target_mm + result.to_light_world * words.distance_mm;
    }
    return result;
}

std::string light_text(const Light& light, Vec3 target_mm) {
    LightWords words(light, target_mm);
    const auto keys = words.keys();
    return key_value_text(keys_for(light.kind, keys));
}

}  // namespace dermis
