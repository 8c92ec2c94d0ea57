// The look as a text: what is neither camera nor light and still changes the picture of the same objects.

#include <algorithm>
#include <array>

#include "dermis/base/angle.h"
#include "dermis/base/text.h"
#include "dermis/scene/key_value_text.h"
#include "dermis/scene/scene.h"

namespace dermis {
namespace {

constexpr std::string_view kToneMap = "tone_map=", kProfile = "profile=";

// The numbers of a look; keys() ties names and ranges to them.
struct LookWords {
    float exposure_ev, surroundings, turned_deg, in_the_picture;
    Vec3 tint;

    explicit LookWords(const Scene& scene)
        : exposure_ev(scene.exposure_ev),
          surroundings(scene.environment.intensity),
          turned_deg(scene.environment.yaw_rad * kDegreesPerRadian),
          in_the_picture(scene.environment.visible ? 1.0f : 0.0f),
          tint(scene.skin.albedo_tint_linear) {}
    std::array<TextKey, 5> keys() {
        return {TextKey{"exposure_ev", "stops", -20, 20, &exposure_ev},
                TextKey{"tint", "linear, times the skin's colour", 0, 100, &tint.x, 3},
                TextKey{"surroundings", "times their light", 0, 1e4, &surroundings},
                TextKey{"turned", "degrees, the surroundings about the vertical", -360, 360, &turned_deg},
                TextKey{"in_the_picture", "1: the surroundings are the background", 0, 1, &in_the_picture}};
    }
};

std::string words_that_differ(std::string_view text, std::string_view than) {
    const std::vector<std::string_view> old = split(than, ' ');
    std::string result;
    for (const std::string_view word : split(text, ' '))
        if (std::ranges::find(old, word) == old.end())
            result += (result.empty() ? "" : " ") + std::string(word);
    return result;
}

std::string whole_text(const Scene& scene) {
    LookWords words(scene);
    return key_value_text(words.keys()) + ' ' + std::string(kToneMap) +
           tone_map_names()[size_t(scene.tone_map)] + ' ' + std::string(kProfile) + scene.skin.profile;
}

}  // namespace

Result<void> parse_look(std::string_view text, Scene& scene) {
    LookWords words(scene);
    ToneMap tone_map = scene.tone_map;
    std::string profile = scene.skin.profile, numbers;
    for (const std::string_view word : split(text, ' ')) {
        if (word.starts_with(kToneMap)) {
            const Result<ToneMap> parsed = parse_tone_map(word.substr(kToneMap.size()));
            if (!parsed) return Error{"look: " + parsed.error().message};
            tone_map = *parsed;
        } else if (word.starts_with(kProfile)) {
            profile = word.substr(kProfile.size());
        } else {
            numbers += std::string(word) + ' ';
        }
    }
    if (Result<void> parsed = parse_key_values("look", numbers, words.keys()); !parsed) return parsed;
    scene.tone_map = tone_map;
    scene.skin.profile = profile;
    scene.exposure_ev = words.exposure_ev;
    scene.skin.albedo_tint_linear = words.tint;
    scene.environment.intensity = words.surroundings;
    scene.environment.yaw_rad = words.turned_deg / kDegreesPerRadian;
    scene.environment.visible = words.in_the_picture > 0.5f;
    return {};
}

std::string look_text(const Scene& scene, const Scene& than) {
    return words_that_differ(whole_text(scene), whole_text(than));
}

}  // namespace dermis
