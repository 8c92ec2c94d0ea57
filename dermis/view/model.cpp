#include "dermis/view/model.h"

#include <algorithm>

#include "dermis/base/text.h"

namespace dermis::view {
namespace {

void add(std::string& key, std::initializer_list<float> numbers) {
    for (const float number : numbers) key += to_text(number) + ' ';
}
void add(std::string& key, Vec3 v) {
    add(key, {v.x, v.y, v.z});
}

}  // namespace

ParameterValues& TechniqueChoice::values() {
    return values_.try_emplace(technique_->id, technique_->parameters).first->second;
}

void Notices::inform(std::string topic, std::string text, double now_s) {
    clear(topic);
    all_.push_back({.topic = std::move(topic), .text = std::move(text), .until_s = now_s + 4});
}

void Notices::complain(std::string topic, std::string text) {
    clear(topic);
    all_.push_back({.topic = std::move(topic), .text = std::move(text), .is_error = true});
}

void Notices::clear(const std::string& topic) {
    std::erase_if(all_, [&](const Notice& notice) { return notice.topic == topic; });
}

void Notices::expire(double now_s) {
    std::erase_if(all_, [&](const Notice& notice) { return !notice.is_error && notice.until_s < now_s; });
}

std::string tone_profile(int tone) {
    return "openpbr_skin_" + std::to_string(tone);
}

std::string truth_key(const Scene& scene) {
    std::string key = scene.skin.profile + ' ';
    add(key, scene.camera.eye_mm);
    add(key, scene.camera.target_mm);
    add(key, {scene.camera.vertical_fov_rad});
    for (const Light& light : scene.lights) {
        add(key, light.color_linear);
        add(key, light.to_light_world);
        add(key, light.position_mm);
        add(key, {light.intensity, light.inner_angle_rad, light.outer_angle_rad});
    }
    add(key, scene.background_linear);
    add(key, scene.skin.albedo_tint_linear);
    add(key, {scene.skin.roughness, scene.skin.specular, scene.skin.ior});
    add(key, {scene.environment.intensity, scene.environment.yaw_rad, float(scene.environment.visible)});
    return key;
}

std::string picture_key(Model& model, size_t choice) {
    const Scene& scene = *model.scene;
    TechniqueChoice& chosen = model.choices[choice];
    std::string key = chosen.technique().id + ' ' + model.view + ' ';
    for (const Parameter& parameter : chosen.technique().parameters.parameters)
        key += chosen.values().text(parameter) + ' ';
    add(key, {scene.exposure_ev, float(scene.tone_map)});
    return key + truth_key(scene);
}

std::string neighbour(const std::vector<std::string>& names, const std::string& name, int step) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) return names.front();
    const auto count = std::ptrdiff_t(names.size());
    return names[size_t((found - names.begin() + step + count) % count)];
}

}  // namespace dermis::view
