#include "dermis/render/frame_values.h"

#include <algorithm>
#include <cmath>

#include "dermis/scene/projection.h"
#include "shaders/include/constants.h"

namespace dermis::inline render {
namespace {

// Any direction that is not along `d`.
Vec3 up_for(Vec3 d) {
    return std::abs(d.y) < 0.99f ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
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

// Part of LightSource in shaders/include/frame.glsl; equal for all pixels if the light's rays are parallel.
struct MapAxes {
    Vec3 x_world, y_world;
    float per_mm = 0, mm_per_z = 0;
};

// x and y are those that light_matrix() looks along.
MapAxes map_axes(const Mat4& light_from_world, Vec3 to_light_world) {
    const Vec3 d = normalize(to_light_world);
    const Vec3 x = normalize(cross(up_for(d), d)), y = cross(d, x);
    const auto in_map = [m = light_from_world.m](Vec3 v) {  // columns
        const auto row = [&](int i) { return m[i] * v.x + m[4 + i] * v.y + m[8 + i] * v.z; };
        return Vec3{0.5f * row(0), 0.5f * row(1), row(2)};
    };
    return {x, y, in_map(x).x, -1 / in_map(d).z};
}

}  // namespace

Mat4 light_matrix(const Light& light, Vec3 center_mm, float radius_mm) {
    if (light.kind == LightKind::directional) {
        const Vec3 direction = normalize(light.to_light_world);
        const Mat4 view = look_along(center_mm + direction * (2 * radius_mm), -direction, up_for(direction));
        return orthographic(radius_mm, radius_mm, 3 * radius_mm) * view;
    }
    const Vec3 eye_mm = light.position_mm;
    const float distance_mm = std::max(length(eye_mm - center_mm), 1e-3f);
    const Vec3 direction = (eye_mm - center_mm) * (1 / distance_mm);
    // The cone around the bounding sphere, at most 150 degrees wide, also for a light near or inside the
    // sphere.
    const float sine = std::min(radius_mm / distance_mm, 0.966f);
    const float near_mm = std::max(distance_mm - radius_mm, 0.01f * distance_mm);
    return perspective(2 * std::asin(sine), 1.0f, near_mm, distance_mm + radius_mm) *
           look_along(eye_mm, -direction, up_for(direction));
}

static_assert(int(LightKind::directional) == kLightDirectional && int(LightKind::point) == kLightPoint &&
              int(LightKind::spot) == kLightSpot);

std::vector<gpu::Values> light_values(const Scene& scene) {
    std::vector<gpu::Values> lights;
    const std::vector<int> maps = scene.shadow_maps();
    for (size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        const Mat4 matrix = light_matrix_of(scene, int(i));
        const MapAxes axes =
            light.kind == LightKind::directional ? map_axes(matrix, light.to_light_world) : MapAxes{};
        lights.push_back({{"kind", int32_t(light.kind)},
                          {"intensity_linear", light.color_linear * light.intensity},
                          {"to_light_world", light.to_light_world},
                          {"position_mm", light.position_mm},
                          {"cos_inner", std::cos(light.inner_angle_rad)},
                          {"cos_outer", std::cos(light.outer_angle_rad)},
                          {"shadow_map_index", int32_t(maps[i])},
                          {"light_view_projection", matrix},
                          {"x_world", axes.x_world},
                          {"y_world", axes.y_world},
                          {"map_per_mm", axes.per_mm},
                          {"mm_per_map_z", axes.mm_per_z}});
    }
    if (lights.empty()) {
        lights.push_back({{"kind", int32_t(kLightDirectional)},
                          {"intensity_linear", Vec3{}},
                          {"to_light_world", Vec3{0, 0, 1}},
                          {"position_mm", Vec3{}},
                          {"cos_inner", 1.0f},
                          {"cos_outer", 0.0f},
                          {"shadow_map_index", int32_t(-1)},
                          {"light_view_projection", Mat4{}},
                          {"x_world", Vec3{}},
                          {"y_world", Vec3{}},
                          {"map_per_mm", 0.0f},
                          {"mm_per_map_z", 0.0f}});
    }
    return lights;
}

// With x' = c x - s z and z' = s x + c z of a direction of unit length, each product of x', y, z' is a sum of
// such products of x, y, z, since x^2 + y^2 + z^2 = 1.
std::array<Vec3, 9> environment_terms(const std::array<Vec3, 9>& sh, float yaw_rad) {
    constexpr float k0 = 0.282095f, k1 = 0.488603f, kXy = 1.092548f, kZz = 0.315392f, kXx = 0.546274f;
    const float c = std::cos(yaw_rad), s = std::sin(yaw_rad);
    const Vec3 xy = sh[4] * kXy, yz = sh[5] * kXy, zz = sh[6] * kZz, xz = sh[7] * kXy, xx = sh[8] * kXx;
    return {sh[0] * k0,
            sh[1] * k1,
            (sh[2] * c - sh[3] * s) * k1,
            (sh[2] * s + sh[3] * c) * k1,
            xy * c + yz * s,
            yz * c - xy * s,
            zz * (c * c - s * s / 2) - xz * (c * s / 2) + xx * (s * s / 2),
            xz * (c * c - s * s) + zz * (6 * s * c) - xx * (2 * s * c),
            xx * ((1 + c * c) / 2) + xz * (c * s / 2) + zz * (1.5f * s * s)};
}

gpu::Values frame_values(const Scene& scene, const FrameValueSettings& settings) {
    const CameraMatrices camera =
        camera_matrices(scene.camera, float(settings.width) / float(settings.height));
    const int key = light_index(scene, true), second = light_index(scene, false);
    const float intensity =
        scene.environment.kind == EnvironmentKind::none ? 0.0f : scene.environment.intensity;
    const float yaw_rad = scene.environment.yaw_rad;
    gpu::Values values = {
        {"view_projection", camera.view_projection},
        {"inverse_view_projection", camera.inverse_view_projection},
        {"light_view_projection", light_matrix_of(scene, key)},
        {"eye_world_mm", scene.camera.eye_mm},
        {"bounds_center_mm", scene.bounds_center_mm},
        {"bounds_radius_mm", scene.bounds_radius_mm},
        {"background_linear", scene.background_linear},
        {"environment_visible",
         int32_t(scene.environment.visible && scene.environment.kind != EnvironmentKind::none)},
        {"environment_intensity", intensity},
        {"environment_turn", Vec2{std::cos(yaw_rad), std::sin(yaw_rad)}},
        {"environment_mip_count", float(settings.environment_mip_count)},
        {"frame_light_count", int32_t(scene.lights.size())},
        {"key_light", int32_t(key)},
        {"shadow_map_texels", float(settings.shadow_map_size)},
        {"shadow_texel_mm", 2 * scene.bounds_radius_mm / float(settings.shadow_map_size)},
        {"penumbra_mm", settings.penumbra_mm},
        {"exposure", std::exp2(scene.exposure_ev)},
        {"second_light", int32_t(second)},
        {"second_light_view_projection", light_matrix_of(scene, second)},
        {"gain_slope_mm", to_vec3(settings.gain.slope_mm)},
        {"gain_length_mm", to_vec3(settings.gain.length_mm)},
        {"gain_bend_mm", to_vec3(settings.gain.bend_mm)},
        {"slab_gain", to_vec3(settings.slab_gain)},
        {"pixel_per_distance", 2 * std::tan(scene.camera.vertical_fov_rad / 2) / float(settings.height)}};
    const std::array<Vec3, 9> terms = environment_terms(settings.environment_sh, yaw_rad);
    for (size_t i = 0; i < terms.size(); ++i)
        values["environment_terms[" + std::to_string(i) + "]"] = terms[i] * intensity;
    const std::vector<gpu::Values> lights = light_values(scene);
    for (const auto& [name, value] : lights.front()) values["first_light." + name] = value;
    return values;
}

}  // namespace dermis::inline render
