#include "dermis/judge/comparison.h"

#include <algorithm>
#include <cmath>

#include "dermis/image/metrics.h"
#include "dermis/judge/effect_reference.h"
#include "dermis/judge/technique_pictures.h"
#include "dermis/render/renderer.h"
#include "dermis/technique/gain.h"

namespace dermis::inline judge {
namespace {

Result<void> check_grid(const ComparisonSettings& settings) {
    const int side = std::max(settings.width, settings.height);
    if (settings.grid >= 1 && side * settings.grid <= kMaxImageSide) return {};
    return Error{std::to_string(settings.grid * settings.grid) + " samples a pixel of a picture of " +
                 std::to_string(settings.width) + "x" + std::to_string(settings.height) + " are drawn " +
                 std::to_string(settings.grid) + " times as wide, more than " +
                 std::to_string(kMaxImageSide) + "; take fewer, or a smaller picture"};
}

EffectReferenceSettings reference_settings(const ComparisonSettings& settings) {
    EffectReferenceSettings wanted{
        .reference = settings.reference, .noise = settings.noise, .samples = settings.samples};
    wanted.reference.width = settings.width;
    wanted.reference.height = settings.height;
    wanted.reference.grid = settings.grid;
    wanted.reference.probes = settings.probes;
    return wanted;
}

Result<Judgement> judgement_of(const Image& effect, const EffectReference& reference,
                               const Comparison& comparison) {
    DERMIS_TRY_ASSIGN(const Captured share, captured(effect, reference.effect, comparison.masks.skin));
    DERMIS_TRY_ASSIGN(std::vector<RegionShare> regions,
                      captured_by_region(effect, reference.effect, comparison.regions));
    return Judgement{share, std::move(regions)};
}

Result<void> judge(const Comparison& comparison, const Scene& scene, Compared& row) {
    const Image& reference = comparison.reference_radiance;
    const Display display{scene.tone_map, std::exp2(scene.exposure_ev)};
    const auto failed = [&](const Error& error) {
        return Error{row.contestant.name() + ": " + error.message};
    };
    Result<Judgement> first = judgement_of(row.effect, comparison.reference, comparison);
    if (!first) return failed(first.error());
    row.first = std::move(*first);
    if (comparison.second) {
        const Image& effect = row.second_effect ? *row.second_effect : row.effect;
        Result<Judgement> second = judgement_of(effect, *comparison.second, comparison);
        if (!second) return failed(second.error());
        row.second = std::move(*second);
    }
    const Result<Scores> scores = score(row.radiance, reference, comparison.masks, display);
    if (!scores) return failed(scores.error());
    row.scores = *scores;
    const Image light = masked_radiance(row.radiance, reference, comparison.masks.skin);
    Result<Image> flip = flip_map(tone_mapped(light, display.tone_map, display.exposure),
                                  tone_mapped(reference, display.tone_map, display.exposure));
    if (!flip) return failed(flip.error());
    Result<Image> distance = abs_difference_map(light, reference);
    if (!distance) return failed(distance.error());
    row.flip = std::move(*flip);
    row.distance = std::move(*distance);
    return {};
}

// Half the difference of the halves is as far from 0 as their mean is from the reference.
double noise_rmse(const EffectReference& reference, const Image& mask) {
    const Image halves = difference(reference.halves[0], reference.halves[1]);
    double sum = 0, count = 0;
    for (size_t i = 0; i < mask.pixel_count(); ++i) {
        if (mask.floats()[i] <= 0) continue;
        for (size_t c = 0; c < 3; ++c)
            sum += double(halves.floats()[3 * i + c]) * halves.floats()[3 * i + c] / 4;
        count += 3;
    }
    return count > 0 ? std::sqrt(sum / count) : 0;
}

// The first and, where wanted, the second.
Result<void> make_references(const Scene& scene, const ComparisonSettings& settings,
                             const ComparisonHooks& hooks, Comparison& comparison) {
    const int count = settings.second ? 2 : 1;
    int made = 0;
    const auto make = [&](Integrator integrator) {
        EffectReferenceSettings wanted = reference_settings(settings);
        wanted.reference.integrator = integrator;
        const auto progress = [&](double done, bool first_samples) {
            if (hooks.reference)
                hooks.reference((made + done) / count, "reference " + std::string(judge_name(integrator)) +
                                                           (first_samples ? ", first samples" : ""));
        };
        return make_effect_reference(scene, wanted, progress, hooks.stop);
    };
    comparison.integrator = settings.reference.integrator;
    comparison.second_integrator = settings.second;
    Result<EffectReference> first = make(comparison.integrator);
    if (!first) return first.error();
    comparison.reference = std::move(*first);
    comparison.reference_radiance = comparison.reference.radiance();
    if (!settings.second) return {};
    ++made;
    Result<EffectReference> second = make(*settings.second);
    if (!second) return second.error();
    comparison.second = std::move(*second);
    return {};
}

// What this integrator judges: `surface` the technique without a gain.
Contestant judged_by(Integrator integrator, Contestant contestant) {
    if (integrator == Integrator::surface) contestant.values = without_gain(contestant.values);
    return contestant;
}

// How the work on the techniques divides, in pictures of one of them: pictures, timed frames, judging.
struct TechniqueWork {
    double pictures, frames, judging;

    explicit TechniqueWork(size_t contestants, const ComparisonSettings& settings)
        : pictures(double(contestants)),
          frames(settings.frames > 0 ? pictures * (settings.frames + 1) / (settings.grid * settings.grid)
                                     : 0),
          judging(0.25 * pictures) {}
    [[nodiscard]] double all() const { return pictures + frames + judging; }
};

// A row as a technique has it, whose effect is the formula's.
Result<void> add_exact(PictureMaker& maker, const Technique& baseline, const Scene& scene,
                       const ComparisonSettings& settings, Comparison& comparison) {
    static const Technique kExact = {.id = std::string(kExactId), .summary = "the exact answer"};
    Result<Image> effect = exact_effect(scene, settings.exact, settings.width, settings.height, settings.grid,
                                        settings.reference.lighting.penumbra_mm);
    if (!effect) return effect.error();
    DERMIS_TRY_ASSIGN(TechniquePictures base, maker.make({&baseline, ParameterValues(baseline.parameters)}));
    Image radiance = std::move(base.radiance);
    for (size_t i = 0; i < effect->pixel_count(); ++i)
        for (size_t c = 0; c < 3; ++c)
            radiance.floats()[size_t(radiance.channels) * i + c] += effect->floats()[3 * i + c];
    comparison.rows.push_back({.contestant = {&kExact, ParameterValues(kExact.parameters)},
                               .radiance = std::move(radiance),
                               .effect = std::move(*effect)});
    return {};
}

// Drawing and timing in one renderer: pictures first, then the costs in rounds.
Result<void> draw_techniques(Renderer& renderer, const Catalog& catalog, const Scene& scene,
                             const std::vector<Contestant>& contestants, const ComparisonSettings& settings,
                             const ComparisonHooks& hooks, Comparison& comparison) {
    DERMIS_TRY_ASSIGN(const Technique* baseline, find_baseline(catalog.techniques));
    PictureMaker maker(renderer, *baseline,
                       {.width = settings.width,
                        .height = settings.height,
                        .grid = settings.grid,
                        .shadow_map_size = settings.shadow_map_size,
                        .penumbra_mm = settings.reference.lighting.penumbra_mm});
    const TechniqueWork work(contestants.size(), settings);
    for (const Contestant& contestant : contestants) {
        if (hooks.techniques)
            hooks.techniques(double(comparison.rows.size()) / work.all(), contestant.name());
        if (hooks.stop && hooks.stop->load()) return Error{"stopped"};
        const Contestant first = judged_by(comparison.integrator, contestant),
                         second = judged_by(settings.second.value_or(comparison.integrator), contestant);
        DERMIS_TRY_ASSIGN(TechniquePictures pictures, maker.make(first));
        comparison.rows.push_back({.contestant = contestant,
                                   .radiance = std::move(pictures.radiance),
                                   .effect = std::move(pictures.effect)});
        if (second.values == first.values) continue;
        DERMIS_TRY_ASSIGN(TechniquePictures beside, maker.make(second));
        comparison.rows.back().second_effect = std::move(beside.effect);
    }
    if (settings.exact)
        if (Result<void> added = add_exact(maker, *baseline, scene, settings, comparison); !added)
            return added;
    Result<SkinMasks> masks = maker.masks(comparison.reference.skin);
    if (!masks) return masks.error();
    comparison.masks = std::move(*masks);
    DERMIS_TRY_ASSIGN(const std::vector<TechniqueCost> costs,
                      measure_costs(renderer, scene, contestants, settings.width, settings.height,
                                    settings.frames, [&](double done, const std::string& name) {
                                        if (hooks.techniques)
                                            hooks.techniques(
                                                (work.pictures + done * work.frames) / work.all(),
                                                "frame times, " + name);
                                    }));
    for (size_t i = 0; i < costs.size(); ++i) comparison.rows[i].cost = costs[i];
    comparison.warnings = renderer.warnings();
    return {};
}

}  // namespace

ComparisonSettings comparison_settings(int width, int height) {
    ComparisonSettings settings{.width = width, .height = height};
    settings.reference = {.width = width,
                          .height = height,
                          .samples = 256,
                          .noise = 0.01,
                          .filter = PixelFilter::center,
                          .entry = LightEntry::all};
    settings.reference.lighting = {.ambient = AmbientModel::renderer,
                                   .specular = SpecularReflection::ggx,
                                   .penumbra_mm = DrawSettings{}.penumbra_mm};
    return settings;
}

Result<Comparison> compare_techniques(gpu::Device& device, const Catalog& catalog, const Scene& scene,
                                      const std::vector<Contestant>& contestants,
                                      const ComparisonSettings& settings, const ComparisonHooks& hooks) {
    if (contestants.empty()) return Error{"no technique to compare"};
    DERMIS_TRY(check_grid(settings));
    // First, as it says at once what it cannot do.
    DERMIS_TRY_ASSIGN(Renderer renderer,
                      Renderer::create(device, gpu::embedded_shaders(catalog.shaders), scene));
    Comparison comparison{.device = device.info().name};
    if (Result<void> made = make_references(scene, settings, hooks, comparison); !made) return made.error();
    if (Result<void> drawn =
            draw_techniques(renderer, catalog, scene, contestants, settings, hooks, comparison);
        !drawn)
        return drawn.error();
    Result<RegionMasks> regions = find_regions(scene, comparison.masks.skin);
    if (!regions) return regions.error();
    comparison.regions = std::move(*regions);
    comparison.reference_rmse = noise_rmse(comparison.reference, comparison.masks.skin);
    const TechniqueWork work(contestants.size(), settings);
    for (size_t i = 0; i < comparison.rows.size(); ++i) {
        const double judged = double(i) / double(comparison.rows.size());
        if (hooks.techniques)
            hooks.techniques((work.pictures + work.frames + judged * work.judging) / work.all(), "scores");
        DERMIS_TRY(judge(comparison, scene, comparison.rows[i]));
    }
    return comparison;
}

const Judgement* judgement_by(Integrator integrator, const Comparison& comparison, const Compared& row) {
    if (comparison.integrator == integrator) return &row.first;
    return comparison.second_integrator == integrator && row.second ? &*row.second : nullptr;
}

std::string_view judge_name(Integrator integrator) {
    return integrator == Integrator::walk ? "walk" : "surface";
}

std::vector<ScoreRow> score_rows(const std::string& scene, const Comparison& comparison) {
    std::vector<ScoreRow> rows;
    const auto share_by = [&](Integrator integrator, const Compared& row) {
        const Judgement* found = judgement_by(integrator, comparison, row);
        return found ? std::optional(found->captured) : std::nullopt;
    };
    for (const Compared& row : comparison.rows)
        rows.push_back({.scene = scene,
                        .technique = row.contestant.technique->id,
                        .settings = row.contestant.settings,
                        .walk = share_by(Integrator::walk, row),
                        .surface = share_by(Integrator::surface, row),
                        .scores = row.scores,
                        .time_ms = row.cost.time_ms,
                        .bytes = row.cost.bytes(),
                        .time_ratio = row.cost.time_ratio,
                        .reference_rmse = comparison.reference_rmse});
    return rows;
}

}  // namespace dermis::inline judge
