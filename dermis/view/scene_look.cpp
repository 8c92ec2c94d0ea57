#include "dermis/view/scene_look.h"

#include "dermis/scene/scene_words.h"

namespace dermis::view {
namespace {

// Rounded as in --scene words: what is equal there counts as unchanged.
std::vector<SceneWord> words_in(const std::vector<SceneWord>& words, std::string_view section) {
    std::vector<SceneWord> some;
    for (const SceneWord& word : words)
        if (word.key.starts_with(section)) some.push_back(word);
    return some;
}

void put_skin(const Skin& seen, Skin& fresh) {
    fresh.profile = seen.profile;
    fresh.albedo_tint_linear = seen.albedo_tint_linear;
}

}  // namespace

void keep_look(const Scene& file_before, const Scene& seen, Scene& fresh) {
    const std::vector<SceneWord> before = words_of(file_before), now = words_of(fresh);
    const auto same = [&](std::string_view section) {
        return words_in(before, section) == words_in(now, section);
    };
    if (same("camera.")) fresh.camera = seen.camera;
    if (same("light.")) fresh.lights = seen.lights;
    if (same("environment.")) fresh.environment = seen.environment;
    if (same("skin.")) put_skin(seen.skin, fresh.skin);
    if (file_before.motion == fresh.motion) fresh.motion = seen.motion;
    if (same("tone_map")) fresh.tone_map = seen.tone_map;
    if (same("exposure_ev")) fresh.exposure_ev = seen.exposure_ev;
    if (same("shadow_maps")) fresh.shadow_map_budget = seen.shadow_map_budget;
    if (same("background")) fresh.background_linear = seen.background_linear;
}

void put_look(const Scene& seen, Scene& fresh) {
    fresh.camera = seen.camera;
    fresh.lights = seen.lights;
    fresh.environment = seen.environment;
    put_skin(seen.skin, fresh.skin);
    fresh.motion = seen.motion;
    fresh.tone_map = seen.tone_map;
    fresh.exposure_ev = seen.exposure_ev;
    fresh.shadow_map_budget = seen.shadow_map_budget;
    fresh.background_linear = seen.background_linear;
}

}  // namespace dermis::view
