#include "compare_options.h"

#include <algorithm>
#include <cmath>

#include "catalog/catalog.h"
#include "compare_scenes.h"
#include "dermis/base/text.h"
#include "dermis/render/complete_scene.h"
#include "dermis/scene/rest_bakes.h"

namespace dermis::cli {
namespace {

constexpr int kMostGrid = 16;
constexpr const char *kSize = "512x512", *kCaseSize = "96x96";

Result<std::vector<OwnPicture>> read_pictures(const std::vector<std::string>& texts) {
    std::vector<OwnPicture> pictures;
    for (const std::string& text : texts) {
        Result<OwnPictureFiles> files = parse_own_picture(text);
        if (!files) return files.error().within("--picture");
        Result<OwnPicture> picture = read_own_picture(*files);
        if (!picture) return picture.error().within("--picture");
        pictures.push_back(std::move(*picture));
    }
    return pictures;
}

// "normals,gain+curvature": two lists.
Result<std::vector<RestBakes>> read_rest_bakes(const std::string& text) {
    std::vector<RestBakes> lists;
    if (text.empty()) return lists;
    for (const std::string_view list : split(text, ',')) {
        const Result<RestBakes> bakes = parse_rest_bakes(list);
        if (!bakes) return bakes.error().within("--rest-bakes");
        if (bakes->any()) lists.push_back(*bakes);
    }
    return lists;
}

Result<void> check_clip(const CompareChoice& choice, bool is_set) {
    if (!choice.rest_bakes.empty() && is_set)
        return Error{"--rest-bakes: " + choice.scene.name + " is a set of scenes, which do not move"};
    if (choice.fps > 0 && choice.frames == 0)
        return Error{"--fps is for the frames of a clip: --clip NAME --frames 8 --fps 24"};
    if (choice.frames == 0) return {};
    DERMIS_TRY(check_number("--frames", choice.frames, kClipFramesRange));
    if (choice.scene.pose.clip.empty())
        return Error{"--frames " + std::to_string(choice.frames) +
                     " is for the frames of a clip: --clip NAME --frames 8 (--timed-frames sets how many "
                     "frames are timed)"};
    if (!choice.pictures.empty())
        return Error{"--picture: shows one frame; leave --frames out and give its --time"};
    return {};
}

std::string noise_text(const EffectNoise& noise) {
    if (!(noise.noise_rms < noise.effect_rms)) return "more noise than effect";
    const double share = noise.noise_rms / noise.effect_rms;
    return "a noise of " + to_text(float(std::round(1000 * share) / 1000)) + " of the effect";
}

}  // namespace

Result<ComparisonSettings> CompareChoice::settings() const {
    const bool is_set = set_of_scenes(scene.name) != nullptr;
    if (is_set && !pictures.empty())
        return Error{"--picture: " + scene.name + " is a set of scenes; name the one that it shows"};
    DERMIS_TRY_ASSIGN(std::vector<OwnPicture> own, read_pictures(pictures));
    DERMIS_TRY_ASSIGN(Size pixels, parse_size(!size.empty() ? size : is_set ? kCaseSize : kSize));
    if (size.empty() && !own.empty()) pixels = {own.front().with.width, own.front().with.height};
    ComparisonSettings settings = comparison_settings(pixels.width, pixels.height);
    settings.pictures = std::move(own);
    settings.frames = timed_frames;
    DERMIS_TRY(check_clip(*this, is_set));
    DERMIS_TRY_ASSIGN(settings.rest_bakes, read_rest_bakes(rest_bakes));
    settings.noise = noise;
    settings.samples = samples;
    if (samples_per_pixel != 0)
        settings.grid = int(std::lround(std::sqrt(double(std::max(samples_per_pixel, 0)))));
    const int points = settings.grid * settings.grid;
    for (const Result<void>& in_range : {check_number("--timed-frames", timed_frames, kTimedFramesRange),
                                         check_number("--noise", noise, kReferenceNoiseRange),
                                         check_number("--samples", samples, kReferenceSamplesRange)})
        if (!in_range) return in_range.error();
    if (settings.grid < 1 || settings.grid > kMostGrid ||
        (samples_per_pixel != 0 && points != samples_per_pixel))
        return Error{"--samples-per-pixel " + std::to_string(samples_per_pixel) +
                     ": a square number, 1, 4, 9, 16 ... " + std::to_string(kMostGrid * kMostGrid)};
    const std::vector<std::string> integrators = {"both", "walk", "surface"},
                                   ambients = {"renderer", "traced"};
    if (std::ranges::find(integrators, integrator) == integrators.end())
        return Error{unknown_name("integrator", integrator, integrators)};
    if (std::ranges::find(ambients, ambient) == ambients.end())
        return Error{unknown_name("ambient model", ambient, ambients)};
    if (integrator != "surface") settings.reference.integrator = Integrator::walk;
    if (integrator == "both") settings.second = Integrator::surface;
    if (ambient == "traced") settings.reference.lighting.ambient = AmbientModel::traced;
    return settings;
}

Result<std::vector<Contestant>> CompareChoice::contestants() const {
    const std::span<const Technique> known = built_in_catalog().techniques;
    if (techniques.empty()) return default_contestants(known);
    Result<std::vector<Contestant>> list = parse_technique_list(known, techniques);
    return list ? std::move(list) : list.error().within("--techniques");
}

Result<Scene> CompareChoice::load_scene() const {
    SceneChoice loaded = scene;
    if (!rest_bakes.empty()) loaded.words.push_back("animation.rest_bakes=all");
    Result<Scene> made = loaded.load();
    if (!made) return made;
    if (!rest_bakes.empty()) {
        made->rest_bakes = {};
        if (std::ranges::all_of(made->objects, [](const SceneObject& o) { return o.motion.empty(); }))
            return Error{"--rest-bakes: " + scene.name +
                         " does not move: it has no clip, morph target or skin"};
    }
    DERMIS_TRY(complete_scene(*made));
    return made;
}

std::vector<std::string> warnings_of(const Comparison& comparison, const ComparisonSettings& settings) {
    std::vector<std::string> warnings = comparison.warnings;
    const auto add = [&](Integrator integrator, const EffectReference& reference) {
        warnings.insert(warnings.end(), reference.warnings.begin(), reference.warnings.end());
        if (reference.reached) return;
        const std::string name = "the reference " + std::string(judge_name(integrator));
        if (reference.stopped)
            warnings.push_back(name + " was stopped with " + noise_text(reference.noise) +
                               "; the same command goes on from there");
        else
            warnings.push_back(name + " stopped at its limit of " + std::to_string(settings.samples) +
                               " samples a pixel with " + noise_text(reference.noise) + ", not " +
                               to_text(settings.noise) + "; raise --samples");
    };
    add(comparison.integrator, comparison.reference);
    if (comparison.second) add(*comparison.second_integrator, *comparison.second);
    return warnings;
}

}  // namespace dermis::cli
