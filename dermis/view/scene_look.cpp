#include "dermis/view/scene_look.h"

#include "dermis/base/text.h"

namespace dermis::view {
namespace {

// As text, rounded: what is equal there is the same to a person.
std::string key_of(const std::vector<Light>& lights) {
    std::string key;
    for (const Light& light : lights)
        key +=
            light.name + std::to_string(int(light.kind)) + light_text(light) + (light.is_key ? " key;" : ";");
    return key;
}

std::string key_of(const Environment& environment) {
    return std::to_string(int(environment.kind)) + environment.file.string() + ' ' +
           to_text(environment.intensity) + ' ' + to_text(environment.yaw_rad) +
           (environment.visible ? " visible" : "");
}

bool same_skin(const Skin& a, const Skin& b) {
    return a.profile == b.profile && a.albedo_tint_linear == b.albedo_tint_linear;
}

void put_skin(const Skin& seen, Skin& fresh) {
    fresh.profile = seen.profile;
    fresh.albedo_tint_linear = seen.albedo_tint_linear;
}

}  // namespace

SceneLook look_of(const Scene& scene) {
    return {.camera = scene.camera,
            .lights = scene.lights,
            .environment = scene.environment,
            .skin = scene.skin,
            .tone_map = scene.tone_map,
            .exposure_ev = scene.exposure_ev,
            .technique = scene.technique,
            .settings = scene.settings};
}

void keep_look(const SceneLook& file_before, const SceneLook& seen, Scene& fresh) {
    if (camera_text(fresh.camera) == camera_text(file_before.camera)) fresh.camera = seen.camera;
    if (key_of(fresh.lights) == key_of(file_before.lights)) fresh.lights = seen.lights;
    if (key_of(fresh.environment) == key_of(file_before.environment)) fresh.environment = seen.environment;
    if (same_skin(fresh.skin, file_before.skin)) put_skin(seen.skin, fresh.skin);
    if (fresh.tone_map == file_before.tone_map) fresh.tone_map = seen.tone_map;
    if (fresh.exposure_ev == file_before.exposure_ev) fresh.exposure_ev = seen.exposure_ev;
}

void put_look(const SceneLook& seen, Scene& fresh) {
    fresh.camera = seen.camera;
    fresh.lights = seen.lights;
    fresh.environment = seen.environment;
    put_skin(seen.skin, fresh.skin);
    fresh.tone_map = seen.tone_map;
    fresh.exposure_ev = seen.exposure_ev;
}

}  // namespace dermis::view
