// A loaded scene as --scene words: describe it, then print every row of the tables.

#include <cmath>
#include <limits>

#include "dermis/base/angle.h"
#include "dermis/base/text.h"
#include "dermis/scene/scene_views.h"
#include "dermis/scene/scene_words.h"
#include "dermis/scene/toml_values.h"

namespace dermis::inline scene {
namespace {

// The keys of a light's short form; the window changes no others.
constexpr const char* kLightKeys[] = {"yaw_deg", "pitch_deg", "intensity", "color", "distance_mm"};
constexpr const char* kCameraKeys[] = {"yaw_deg", "pitch_deg", "distance_mm", "fov_deg", "target_mm"};

// To a power of ten of at least four times the error: what is read from the rounded value rounds to it again.
void round_to(std::optional<float>& value, double error) {
    const double step = std::pow(10, std::ceil(std::log10(4 * error)));
    if (value && std::isfinite(step) && step > 0) value = float(std::round(double(*value) / step) * step);
}

// Leaves out of a camera or a light the digits that are below the rounding of float positions: a text that is
// read and written again stays as it is.
template <class Description>
Description without_rounding(Description seen, Vec3 target_mm) {
    const double distance_mm = double(seen.distance_mm.value_or(1));
    const double error_mm =
        std::numeric_limits<float>::epsilon() * (distance_mm + 2 * double(length(target_mm)));
    const double horizontal_mm =
        distance_mm * std::cos(double(seen.pitch_deg.value_or(0) * kRadiansPerDegree));
    round_to(seen.yaw_deg, error_mm / horizontal_mm / kRadiansPerDegree);
    round_to(seen.pitch_deg, error_mm / distance_mm / kRadiansPerDegree);
    round_to(seen.distance_mm, error_mm);
    return seen;
}

CameraDescription described(const Camera& camera) {
    return without_rounding(describe(camera), camera.target_mm);
}

LightDescription described(const Light& light, Vec3 center_mm) {
    return without_rounding(describe(light, center_mm),
                            light.kind == LightKind::directional ? Vec3{} : center_mm);
}

// Rounded, so that 20 degrees are not printed as 19.999998.
std::string number_text(double value) {
    const double rounded = std::round(value * 1e4) / 1e4;
    return to_text(rounded == 0 ? 0.0 : rounded);
}

std::string numbers_text(const KeyValue& value, const char* between) {
    return number_text(value.numbers[0]) + between + number_text(value.numbers[1]) + between +
           number_text(value.numbers[2]);
}

template <class Target>
void add_keys(const KeyTable<Target>& table, const std::string& section, const Target& target, bool all,
              std::vector<SceneKey>& keys, int light = 0) {
    for (const Key<Target>& key : table.keys()) {
        KeyValue value;
        if ((all || key.info.changeable) && key.get && key.get(target, value))
            keys.push_back({section, light, &key.info, value});
    }
}

template <class Target, size_t N>
std::string text_of(const KeyTable<Target>& table, const Target& target, const char* const (&names)[N]) {
    std::string text;
    for (const char* name : names) {
        const Key<Target>* key = table.find(name);
        KeyValue value;
        if (!key->get(target, value)) continue;
        text += (text.empty() ? "" : " ") + std::string(name) + "=" + word_text(key->info, value);
    }
    return text;
}

}  // namespace

std::string word_text(const KeyInfo& info, const KeyValue& value) {
    if (info.kind == KeyKind::number) return number_text(value.numbers[0]);
    if (info.kind == KeyKind::vector || info.kind == KeyKind::color) return numbers_text(value, ",");
    return key_text(info, value);
}

std::string toml_value(const KeyInfo& info, const KeyValue& value) {
    switch (info.kind) {
        case KeyKind::text:
        case KeyKind::file:
        case KeyKind::choice:
            return toml_string(key_text(info, value));
        case KeyKind::vector:
        case KeyKind::color:
            return "[" + numbers_text(value, ", ") + "]";
        default:
            return word_text(info, value);
    }
}

std::vector<SceneKey> keys_of(const Scene& scene) {
    const SceneDescription description = describe(scene);
    std::vector<SceneKey> keys;
    add_keys(head_keys(), "", description.head, false, keys);
    add_keys(skin_keys(), "skin", description.skin, false, keys);
    for (size_t i = 0; i < description.lights.size(); ++i)
        add_keys(light_keys(), "light", described(scene.lights[i], scene.bounds_center_mm), true, keys,
                 int(i));
    add_keys(environment_keys(), "environment", *description.environment, true, keys);
    add_keys(camera_keys(), "camera", described(scene.camera), true, keys);
    return keys;
}

std::vector<SceneWord> words_of(const Scene& scene) {
    std::vector<SceneWord> words;
    for (const SceneKey& key : keys_of(scene)) {
        std::string section = key.section.empty() ? "" : key.section + ".";
        if (key.section == "light")
            section += scene.lights[size_t(key.light)].is_key ? "key." : std::to_string(key.light + 1) + ".";
        words.push_back({section + key.info->name, word_text(*key.info, key.value)});
    }
    return words;
}

std::string camera_text(const Camera& camera) {
    return text_of(camera_keys(), described(camera), kCameraKeys);
}

std::string light_text(const Light& light, Vec3 target_mm) {
    return text_of(light_keys(), described(light, target_mm), kLightKeys);
}

}  // namespace dermis::inline scene
