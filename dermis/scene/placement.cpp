#include "dermis/scene/placement.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "dermis/base/angle.h"
#include "dermis/base/text.h"
#include "dermis/optics/mtlx.h"
#include "shaders/include/constants.h"

namespace dermis::inline scene {
namespace {

// Nothing unless the profile is a MaterialX document; its errors are reported when the profile is
// read.
MtlxSurface surface_of_profile(const Skin& skin) {
    if (!to_lower(skin.profile).ends_with(".mtlx")) return {};
    const Result<MtlxSurface> surface = read_mtlx_surface(skin.profile);
    MtlxSurface found = surface ? *surface : MtlxSurface{};
    if (found.ior && *found.ior > kMostSkinIor) found.ior.reset();
    return found;
}

}  // namespace

std::string surface_difference(const Skin& skin) {
    const MtlxSurface surface = surface_of_profile(skin);
    std::vector<std::string> parts;
    const auto compare = [&](const char* name, const std::optional<double>& stated, const char* key,
                             float has) {
        if (stated && std::abs(*stated - double(has)) > 1e-4)
            parts.push_back(std::string(name) + " " + to_text(float(*stated)) + " is not used: " + key +
                            " is " + to_text(has));
    };
    compare("specular_roughness", surface.roughness, "skin.roughness", skin.roughness);
    compare("specular_ior", surface.ior, "skin.ior", skin.ior);
    return parts.empty() ? std::string() : skin.profile + ": " + join(parts, "; ");
}

Skin with_surface_of_profile(Skin skin) {
    const MtlxSurface surface = surface_of_profile(skin);
    if (surface.roughness && skin.roughness == Skin{}.roughness) skin.roughness = float(*surface.roughness);
    if (surface.ior && skin.ior == Skin{}.ior) skin.ior = float(*surface.ior);
    return skin;
}

void apply_skin(const Skin& skin, Material& material) {
    material.ior = skin.ior;
    material.roughness = skin.roughness;
    material.specular = skin.specular;
}

void compute_bounds(Scene& scene) {
    Vec3 low = {INFINITY, INFINITY, INFINITY}, high = -low;
    for (const SceneObject& object : scene.objects)
        for (const Vec3 p : object.mesh.positions_mm) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
    scene.bounds_center_mm = low.x <= high.x ? (low + high) * 0.5f : Vec3{};
    scene.bounds_radius_mm = 0;
    for (const SceneObject& object : scene.objects)
        for (const Vec3 p : object.mesh.positions_mm)
            scene.bounds_radius_mm = std::max(scene.bounds_radius_mm, length(p - scene.bounds_center_mm));
    if (scene.bounds_radius_mm <= 0) scene.bounds_radius_mm = 1;
}

void light_in_studio(Scene& scene) {
    scene.lights = {
        {.name = "key",
         .color_linear = {1, 0.93f, 0.84f},
         .intensity = kPi,
         .to_light_world = direction_from_yaw_pitch(-50 * kRadiansPerDegree, 35 * kRadiansPerDegree),
         .is_key = true}};
    scene.environment = {.kind = EnvironmentKind::studio, .intensity = 0.75f};
}

void place_in_studio(Scene& scene) {
    compute_bounds(scene);
    light_in_studio(scene);
    scene.exposure_ev = 0.6f;
    scene.camera = framing_camera(scene.bounds_center_mm, scene.bounds_radius_mm);
}

const Light& Scene::key_light() const {
    const auto found = std::ranges::find_if(lights, &Light::is_key);
    return found == lights.end() ? lights.front() : *found;
}

std::vector<int> Scene::shadow_maps() const {
    std::vector<int> maps(lights.size(), -1);
    // Map 0 is reserved for the key light, even if it casts no shadow.
    int used = 0, next = 1;
    for (size_t i = 0; i < lights.size(); ++i)
        if (lights[i].is_key && lights[i].casts_shadow && used < shadow_map_budget) maps[i] = 0, ++used;
    for (size_t i = 0; i < lights.size(); ++i)
        if (!lights[i].is_key && lights[i].casts_shadow && used < shadow_map_budget && next < kMaxShadowMaps)
            maps[i] = next++, ++used;
    return maps;
}

}  // namespace dermis::inline scene
