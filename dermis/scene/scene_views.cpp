#include "dermis/scene/scene_views.h"

#include "dermis/base/angle.h"
#include "dermis/scene/placement.h"
#include "dermis/scene/scene_files.h"
#include "shaders/include/constants.h"

namespace dermis::inline scene {
namespace {

Result<Environment> place_environment(const SceneDescription& description,
                                      const EnvironmentDescription& given) {
    Environment environment{.kind = given.kind.value_or(EnvironmentKind::studio),
                            .intensity = given.intensity,
                            .yaw_rad = given.yaw_deg * kRadiansPerDegree,
                            .visible = given.visible};
    if (!given.file.given()) return environment;
    DERMIS_TRY_ASSIGN(const std::filesystem::path path, resolve_file(description, given.file));
    environment.kind = EnvironmentKind::file;
    environment.file = path;
    return environment;
}

EnvironmentDescription describe(const Environment& environment) {
    EnvironmentDescription given{.kind = environment.kind,
                                 .intensity = environment.intensity,
                                 .yaw_deg = environment.yaw_rad / kRadiansPerDegree,
                                 .visible = environment.visible};
    if (environment.kind == EnvironmentKind::file)
        given.file = {.text = std::filesystem::absolute(environment.file).lexically_normal().string(),
                      .key = "environment.file"};
    return given;
}

struct Orbit {
    float yaw_deg = 0, pitch_deg = 0, distance_mm = 0;

    explicit Orbit(Vec3 from_target) : distance_mm(length(from_target)) {
        const YawPitch angles = yaw_pitch_of(from_target);
        yaw_deg = angles.yaw_rad / kRadiansPerDegree;
        pitch_deg = angles.pitch_rad / kRadiansPerDegree;
    }
};

}  // namespace

Light place_light(const LightDescription& given, Vec3 center_mm) {
    const Vec3 target_mm = given.target_mm.value_or(center_mm);
    const Vec3 direction = direction_from_yaw_pitch(given.yaw_deg.value_or(0) * kRadiansPerDegree,
                                                    given.pitch_deg.value_or(0) * kRadiansPerDegree);
    Light light{.name = given.name,
                .kind = given.kind,
                .color_linear = given.color_linear,
                .intensity = given.intensity,
                .to_light_world = direction,
                .position_mm = target_mm + direction * given.distance_mm.value_or(0),
                .inner_angle_rad = given.inner_angle_deg * kRadiansPerDegree,
                .outer_angle_rad = given.outer_angle_deg * kRadiansPerDegree,
                .is_key = given.key.value_or(false),
                .casts_shadow = given.shadow};
    if (given.position_mm) {
        light.position_mm = *given.position_mm;
        const Vec3 axis = normalize(*given.position_mm - target_mm);
        if (length(axis) > 0) light.to_light_world = axis;
    }
    return light;
}

Camera place_camera(const CameraDescription& given, Vec3 center_mm, float radius_mm) {
    Camera camera =
        framing_camera(given.target_mm.value_or(center_mm), radius_mm, given.fov_deg * kRadiansPerDegree);
    const float framing_mm = length(camera.eye_mm - camera.target_mm);
    camera.eye_mm = given.eye_mm.value_or(
        camera.target_mm + direction_from_yaw_pitch(given.yaw_deg.value_or(0) * kRadiansPerDegree,
                                                    given.pitch_deg.value_or(0) * kRadiansPerDegree) *
                               given.distance_mm.value_or(framing_mm));
    fit_depth_range(camera, center_mm, radius_mm);
    return camera;
}

Result<void> place_views(const SceneDescription& description, Scene& scene) {
    light_in_studio(scene);
    scene.camera = place_camera(description.camera, scene.bounds_center_mm, scene.bounds_radius_mm);
    if (!description.lights.empty()) scene.lights.clear();
    for (const LightDescription& light : description.lights)
        scene.lights.push_back(place_light(light, scene.bounds_center_mm));
    if (description.environment) {
        Result<Environment> environment = place_environment(description, *description.environment);
        if (!environment) return environment.error();
        scene.environment = *environment;
    }
    scene.skin = description.skin;
    const HeadDescription& head = description.head;
    scene.background_linear = head.background_linear;
    scene.tone_map = head.tone_map;
    scene.exposure_ev = head.exposure_ev;
    scene.shadow_map_budget = head.shadow_maps;
    const std::vector<int> maps = scene.shadow_maps();
    std::vector<size_t> without;
    for (size_t i = 0; i < scene.lights.size(); ++i)
        if (scene.lights[i].casts_shadow && maps[i] < 0) without.push_back(i + 1);
    if (without.empty()) return {};
    const size_t more = without.size() - 1;
    scene.warnings.push_back("light " + std::to_string(without.front()) +
                             (more == 0 ? " casts" : " and " + std::to_string(more) + " more cast") +
                             " no shadow: shadow_maps = " + std::to_string(scene.shadow_map_budget) +
                             "; raise it (at most " + std::to_string(kMaxShadowMaps) +
                             ") or give such a light shadow = false");
    return {};
}

LightDescription describe(const Light& light, Vec3 center_mm) {
    const bool directional = light.kind == LightKind::directional;
    const Orbit orbit(directional ? light.to_light_world : light.position_mm - center_mm);
    LightDescription given{.name = light.name,
                           .kind = light.kind,
                           .color_linear = light.color_linear,
                           .intensity = light.intensity,
                           .yaw_deg = orbit.yaw_deg,
                           .pitch_deg = orbit.pitch_deg,
                           .inner_angle_deg = light.inner_angle_rad / kRadiansPerDegree,
                           .outer_angle_deg = light.outer_angle_rad / kRadiansPerDegree,
                           .key = light.is_key,
                           .shadow = light.casts_shadow};
    if (!directional) given.distance_mm = orbit.distance_mm;
    return given;
}

CameraDescription describe(const Camera& camera) {
    const Orbit orbit(camera.eye_mm - camera.target_mm);
    return {.target_mm = camera.target_mm,
            .yaw_deg = orbit.yaw_deg,
            .pitch_deg = orbit.pitch_deg,
            .distance_mm = orbit.distance_mm,
            .fov_deg = camera.vertical_fov_rad / kRadiansPerDegree};
}

SceneDescription describe(const Scene& scene) {
    SceneDescription description{.head = {.background_linear = scene.background_linear,
                                          .tone_map = scene.tone_map,
                                          .exposure_ev = scene.exposure_ev,
                                          .shadow_maps = scene.shadow_map_budget},
                                 .skin = scene.skin,
                                 .environment = describe(scene.environment),
                                 .camera = describe(scene.camera)};
    for (const Light& light : scene.lights)
        description.lights.push_back(describe(light, scene.bounds_center_mm));
    return description;
}

Scene without_objects(const Scene& scene) {
    return {.name = scene.name,
            .lights = scene.lights,
            .shadow_map_budget = scene.shadow_map_budget,
            .camera = scene.camera,
            .environment = scene.environment,
            .skin = scene.skin,
            .motion = scene.motion,
            .background_linear = scene.background_linear,
            .tone_map = scene.tone_map,
            .exposure_ev = scene.exposure_ev,
            .technique = scene.technique,
            .settings = scene.settings,
            .bounds_center_mm = scene.bounds_center_mm,
            .bounds_radius_mm = scene.bounds_radius_mm};
}

}  // namespace dermis::inline scene
