#include "dermis/judge/comparison.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "dermis/image/metrics.h"
#include "dermis/judge/effect_reference.h"
#include "dermis/judge/technique_pictures.h"
#include "dermis/judge/work_estimate.h"
#include "dermis/render/renderer.h"
#include "dermis/scene/rest_bakes.h"
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

Result<void> check_comparison(const Scene& scene, const std::vector<Contestant>& contestants,
                              const ComparisonSettings& settings) {
    if (contestants.empty() && settings.pictures.empty()) return Error{"no technique to compare"};
    DERMIS_TRY(check_grid(settings));
    if (!settings.rest_bakes.empty() && scene.rest_objects.size() != scene.objects.size())
        return Error{"the scene was loaded without its rest pose (animation.rest_bakes)"};
    for (const OwnPicture& picture : settings.pictures)
        DERMIS_TRY(check_own_picture(picture, settings.width, settings.height));
    return {};
}

EffectReferenceSettings reference_settings(const ComparisonSettings& settings, Integrator integrator) {
    EffectReferenceSettings wanted{
        .reference = settings.reference, .noise = settings.noise, .samples = settings.samples};
    wanted.reference.width = settings.width;
    wanted.reference.height = settings.height;
    wanted.reference.grid = settings.grid;
    wanted.reference.integrator = integrator;
    wanted.reference.probes = integrator == Integrator::walk ? settings.walks : settings.probes;
    return wanted;
}

// `remade`: the effect with all bakes of the pose, where `effect` has some of the rest pose.
Result<Judgement> judgement_of(const Image& effect, const EffectReference& reference,
                               const Comparison& comparison, const Image* remade) {
    const Image& skin = comparison.masks.skin;
    DERMIS_TRY_ASSIGN(const Captured share, captured(effect, reference.effect, skin));
    DERMIS_TRY_ASSIGN(std::vector<RegionShare> regions,
                      captured_by_region(effect, reference.effect, comparison.regions));
    Judgement judgement{.captured = share, .regions = std::move(regions)};
    if (!remade) return judgement;
    DERMIS_TRY_ASSIGN(judgement.change, share_change(*remade, effect, reference.effect, skin));
    return judgement;
}

Result<void> judge(const Comparison& comparison, const Scene& scene, Compared& row) {
    const Image& reference = comparison.reference_radiance;
    const Display display{scene.tone_map, std::exp2(scene.exposure_ev)};
    const auto failed = [&](const Error& error) {
        return Error{row.contestant.name() + ": " + error.message};
    };
    const Compared* remade = row.remade ? &comparison.rows[*row.remade] : nullptr;
    Result<Judgement> first =
        judgement_of(row.effect, comparison.reference, comparison, remade ? &remade->effect : nullptr);
    if (!first) return failed(first.error());
    row.first = std::move(*first);
    if (comparison.second) {
        Result<Judgement> second = judgement_of(row.effect_of_second(), *comparison.second, comparison,
                                                remade ? &remade->effect_of_second() : nullptr);
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

// A comparison in the making.
struct ComparisonWork {
    const Scene& scene;
    const ComparisonSettings& settings;
    const ComparisonHooks& hooks;
    WorkEstimate estimate{};
    std::vector<EffectReferenceMaker> references{};  // the first, the second
    Comparison comparison{};

    [[nodiscard]] bool stopped() const { return hooks.stop && hooks.stop->load(); }
    [[nodiscard]] bool cancelled() const { return hooks.cancel && hooks.cancel->load(); }
    [[nodiscard]] Integrator integrator(size_t reference) const {
        return reference == 0 ? settings.reference.integrator : *settings.second;
    }
    [[nodiscard]] double references_left_s() const {
        double left_ms = 0;
        for (const EffectReferenceMaker& reference : references) left_ms += reference.left_ms();
        return left_ms / 1000;
    }
    void show(const std::string& name) {
        if (hooks.progress) hooks.progress(estimate.done(), name);
    }
};

using Part = WorkEstimate::Part;

// Seconds of parts that have not begun, of two cores and a driver for the CPU. Too long rather than too
// short, as the share that is done never falls.
void guess_times(ComparisonWork& work, size_t contestants) {
    constexpr double kFirstS = 3, kReferenceS = 15, kFrameS = 0.2, kPicturePointsPerS = 2e5,
                     kUnscatteredPixelsPerS = 1e4, kJudgedPixelsPerS = 2e5;
    const ComparisonSettings& s = work.settings;
    const double pixels = double(s.width) * s.height, points = pixels * s.grid * s.grid,
                 rows = double(contestants * (1 + s.rest_bakes.size())), references = s.second ? 2 : 1;
    work.estimate.set_left(Part::first_samples, kFirstS);
    work.estimate.set_left(Part::pictures, double(contestants) * points / kPicturePointsPerS);
    work.estimate.set_left(Part::second_samples, (references - 1) * kFirstS);
    work.estimate.set_left(Part::second_pictures, rows * points / kPicturePointsPerS);
    work.estimate.set_left(Part::frames, double(contestants) * (s.frames > 0 ? s.frames + 1 : 0) * kFrameS);
    work.estimate.set_left(Part::unscattered, pixels / kUnscatteredPixelsPerS);
    work.estimate.set_left(Part::references, references * kReferenceS);
    work.estimate.set_left(Part::judging, rows * pixels / kJudgedPixelsPerS);
}

// The shares of all rows, of a reference so far.
void report_shares(const ComparisonWork& work, size_t reference) {
    const Comparison& comparison = work.comparison;
    if (!work.hooks.shares || comparison.rows.empty()) return;
    const Integrator integrator = work.integrator(reference);
    std::vector<CapturedShare> shares;
    for (const Compared& row : comparison.rows) {
        const Result<Captured> share =
            captured(reference == 1 ? row.effect_of_second() : row.effect,
                     work.references[reference].so_far().effect, comparison.masks.skin);
        if (!share) return;  // judge() names it
        shares.push_back(share->all);
    }
    work.hooks.shares(integrator, comparison.rows, shares);
}

std::string reference_name(const ComparisonWork& work, size_t reference) {
    return "reference " + std::string(judge_name(work.integrator(reference)));
}

// The first samples of a reference, whose skin the techniques are drawn for.
Result<void> begin_reference(ComparisonWork& work, size_t i, Part part) {
    const auto done = [&](double share, bool) {
        work.estimate.advance(part, share);
        work.show(reference_name(work, i) + ", first samples");
    };
    DERMIS_TRY_ASSIGN(
        EffectReferenceMaker begun,
        EffectReferenceMaker::begin(work.scene, reference_settings(work.settings, work.integrator(i)),
                                    {.done = done, .stop = work.hooks.stop}));
    work.references.push_back(std::move(begun));
    return {};
}

// Refines the one that is farthest from what it must be, until all have this noise over the effect or less.
Result<void> refine_references(ComparisonWork& work, double noise) {
    const auto noisier = [&](const EffectReferenceMaker& a, const EffectReferenceMaker& b) {
        return (a.is_done() ? 0 : a.noise_over_wanted()) < (b.is_done() ? 0 : b.noise_over_wanted());
    };
    while (!work.stopped()) {
        const auto next = std::ranges::max_element(work.references, noisier);
        if (next->is_done() || next->noise_over_wanted() * work.settings.noise <= noise) break;
        const auto i = size_t(next - work.references.begin());
        const double begun_s = work.references_left_s(), own_s = next->left_ms() / 1000;
        const auto done = [&](double share, bool) {
            work.estimate.set_left(Part::references, begun_s - own_s + own_s * (1 - share));
            work.show(reference_name(work, i));
        };
        DERMIS_TRY(next->refine({.done = done, .stop = work.hooks.stop}));
        report_shares(work, i);
    }
    return {};
}

// All references share these pictures: the second finds them in the cache.
Result<void> make_unscattered(ComparisonWork& work, const std::atomic<bool>* stop) {
    for (EffectReferenceMaker& reference : work.references) {
        const auto done = [&](double share) {
            work.estimate.advance(Part::unscattered, share);
            work.show("pictures without scattering");
        };
        DERMIS_TRY(reference.make_unscattered(done, stop));
    }
    work.estimate.set_left(Part::unscattered, 0);
    return {};
}

Result<void> finish_references(ComparisonWork& work) {
    DERMIS_TRY(make_unscattered(work, nullptr));
    work.estimate.advance(Part::judging, 0);
    DERMIS_TRY_ASSIGN(work.comparison.reference, work.references[0].finish());
    if (work.references.size() > 1) {
        DERMIS_TRY_ASSIGN(work.comparison.second, work.references[1].finish());
    }
    work.comparison.reference_radiance = work.comparison.reference.radiance();
    return {};
}

// What this integrator judges: `surface` the technique without a gain.
Contestant judged_by(Integrator integrator, Contestant contestant) {
    if (integrator == Integrator::surface) contestant.values = without_gain(contestant.values);
    return contestant;
}

PictureSettings picture_settings(const ComparisonSettings& settings) {
    return {.width = settings.width,
            .height = settings.height,
            .grid = settings.grid,
            .shadow_map_size = settings.shadow_map_size,
            .penumbra_mm = settings.reference.lighting.penumbra_mm};
}

// The row of a technique as the first reference judges it, drawn by a maker whose renderer may have bakes of
// the rest pose.
Result<Compared> first_row(PictureMaker& maker, PictureMaker& drawn_by, const Contestant& contestant,
                           Integrator integrator) {
    DERMIS_TRY_ASSIGN(TechniquePictures pictures, maker.make(judged_by(integrator, contestant), drawn_by));
    return Compared{.contestant = contestant,
                    .radiance = std::move(pictures.radiance),
                    .effect = std::move(pictures.effect)};
}

// The effect that the second reference judges, where it is another.
Result<void> add_second_effect(PictureMaker& maker, PictureMaker& drawn_by, const ComparisonWork& work,
                               Compared& row) {
    if (work.references.size() < 2) return {};
    const Contestant second = judged_by(work.integrator(1), row.contestant);
    if (second.values == judged_by(work.integrator(0), row.contestant).values) return {};
    DERMIS_TRY_ASSIGN(TechniquePictures pictures, maker.make(second, drawn_by));
    row.second_effect = std::move(pictures.effect);
    return {};
}

bool same_pictures(const Compared& a, const Compared& b) {
    return a.radiance.bytes == b.radiance.bytes && a.effect_of_second().bytes == b.effect_of_second().bytes;
}

// How many pictures are drawn before this one, of all of this part.
Result<void> show_picture(ComparisonWork& work, Part part, size_t drawn, size_t all,
                          const Contestant& contestant) {
    work.estimate.advance(part, double(drawn) / double(all));
    work.show(contestant.name());
    return work.cancelled() ? Result<void>(Error{"stopped"}) : Result<void>();
}

// A row of each technique and of each of the settings' rest_bakes that changes its picture.
Result<void> add_rest_bakes(gpu::Device& device, const Catalog& catalog,
                            const std::vector<Contestant>& contestants, PictureMaker& maker,
                            ComparisonWork& work) {
    const ComparisonSettings& settings = work.settings;
    Comparison& comparison = work.comparison;
    const size_t all = contestants.size() * (1 + settings.rest_bakes.size());
    size_t drawn = contestants.size();
    for (const RestBakes& bakes : settings.rest_bakes) {
        Scene baked = work.scene;
        baked.rest_bakes = bakes;
        DERMIS_TRY_ASSIGN(Renderer renderer,
                          Renderer::create(device, gpu::embedded_shaders(catalog.shaders), baked));
        PictureMaker drawn_by(renderer, maker.baseline(), picture_settings(settings));
        for (size_t i = 0; i < contestants.size(); ++i) {
            Contestant contestant = contestants[i];
            if (contestant.technique->is_baseline) continue;
            contestant.settings +=
                (contestant.settings.empty() ? "rest=" : ",rest=") + rest_bakes_text(bakes);
            DERMIS_TRY(show_picture(work, Part::second_pictures, drawn++, all, contestant));
            DERMIS_TRY_ASSIGN(Compared row, first_row(maker, drawn_by, contestant, comparison.integrator));
            DERMIS_TRY(add_second_effect(maker, drawn_by, work, row));
            row.remade = i;
            if (!same_pictures(row, comparison.rows[i])) comparison.rows.push_back(std::move(row));
        }
    }
    return {};
}

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

// RMS of their difference over that of the first, over the skin.
double relative_difference(const Image& base, const Image& other, const Image& mask) {
    double squares = 0, base_squares = 0;
    for (size_t i = 0; i < mask.pixel_count(); ++i)
        for (size_t c = 0; mask.floats()[i] > 0 && c < 3; ++c) {
            const double is = base.floats()[size_t(base.channels) * i + c];
            squares += std::pow(other.floats()[size_t(other.channels) * i + c] - is, 2);
            base_squares += is * is;
        }
    return base_squares > 0 ? std::sqrt(squares / base_squares) : 0;
}

// After the masks, which say where `without` is held against the baseline.
Result<void> add_pictures(PictureMaker& maker, const Technique& baseline, const ComparisonSettings& settings,
                          Comparison& comparison) {
    static const Technique kPicture = {.id = std::string(kPictureId),
                                       .summary = "a picture of another renderer"};
    if (settings.pictures.empty()) return {};
    DERMIS_TRY_ASSIGN(const TechniquePictures base,
                      maker.make({&baseline, ParameterValues(baseline.parameters)}));
    for (const OwnPicture& picture : settings.pictures) {
        Compared row{.contestant = {&kPicture, ParameterValues(kPicture.parameters), picture.name},
                     .radiance = picture.with,
                     .effect = difference(picture.with, picture.without)};
        const double far = relative_difference(base.radiance, picture.without, comparison.masks.skin);
        if (far > kPictureDifference)
            comparison.warnings.push_back(
                row.contestant.name() + ": without scattering it differs from Dermis' own picture by " +
                std::to_string(std::lround(100 * far)) +
                " % (rms); its share means little until camera, light, albedo and exposure agree");
        comparison.rows.push_back(std::move(row));
    }
    return {};
}

// The techniques' pictures and the masks; the first shares by the first reference.
Result<void> draw_techniques(PictureMaker& maker, const std::vector<Contestant>& contestants,
                             ComparisonWork& work) {
    Comparison& comparison = work.comparison;
    for (const Contestant& contestant : contestants) {
        DERMIS_TRY(
            show_picture(work, Part::pictures, comparison.rows.size(), contestants.size(), contestant));
        DERMIS_TRY_ASSIGN(Compared row, first_row(maker, maker, contestant, comparison.integrator));
        comparison.rows.push_back(std::move(row));
    }
    DERMIS_TRY_ASSIGN(comparison.masks, maker.masks(work.references[0].so_far().skin));
    report_shares(work, 0);
    return {};
}

// What the second reference judges, and the rows that are no techniques.
Result<void> draw_others(gpu::Device& device, const Catalog& catalog, PictureMaker& maker,
                         const std::vector<Contestant>& contestants, ComparisonWork& work) {
    Comparison& comparison = work.comparison;
    const ComparisonSettings& settings = work.settings;
    const size_t all = contestants.size() * (1 + settings.rest_bakes.size());
    for (size_t i = 0; i < contestants.size(); ++i) {
        DERMIS_TRY(show_picture(work, Part::second_pictures, i, all, contestants[i]));
        DERMIS_TRY(add_second_effect(maker, maker, work, comparison.rows[i]));
    }
    DERMIS_TRY(add_rest_bakes(device, catalog, contestants, maker, work));
    if (settings.exact) DERMIS_TRY(add_exact(maker, maker.baseline(), work.scene, settings, comparison));
    DERMIS_TRY(add_pictures(maker, maker.baseline(), settings, comparison));
    work.estimate.advance(Part::second_pictures, 1);
    const bool more = comparison.rows.size() > contestants.size();
    for (size_t i = more ? 0 : 1; i < work.references.size(); ++i) report_shares(work, i);
    return {};
}

// The first samples of the second reference. Stopped before they are there, the first judges alone.
Result<void> begin_second(ComparisonWork& work) {
    if (!work.settings.second) return {};
    const Result<void> begun = begin_reference(work, 1, Part::second_samples);
    if (begun) {
        work.comparison.second_integrator = work.settings.second;
        return {};
    }
    if (!work.stopped() || work.cancelled()) return begun;
    work.comparison.warnings.push_back("stopped before the " + reference_name(work, 1) +
                                       " had samples: without its shares");
    return {};
}

// Noise over the effect at which shares say something: before it is reached, what says nothing of them waits.
constexpr double kFirstNoise = 0.5;

// From the first samples to the first useful shares by both references.
Result<void> begin_comparison(gpu::Device& device, Renderer& renderer, const Catalog& catalog,
                              const std::vector<Contestant>& contestants, ComparisonWork& work) {
    work.comparison.integrator = work.settings.reference.integrator;
    DERMIS_TRY_ASSIGN(const Technique* baseline, find_baseline(catalog.techniques));
    PictureMaker maker(renderer, *baseline, picture_settings(work.settings));
    DERMIS_TRY(begin_reference(work, 0, Part::first_samples));
    DERMIS_TRY(draw_techniques(maker, contestants, work));
    const double noise = std::max(kFirstNoise, work.settings.noise);
    DERMIS_TRY(refine_references(work, noise));
    DERMIS_TRY(begin_second(work));
    DERMIS_TRY(draw_others(device, catalog, maker, contestants, work));
    work.estimate.set_left(Part::references, work.references_left_s());
    return refine_references(work, noise);
}

// Times the techniques, which are the first rows. The rows of other renderers' pictures have no known cost.
Result<void> time_techniques(Renderer& renderer, const std::vector<Contestant>& contestants,
                             ComparisonWork& work) {
    const ComparisonSettings& settings = work.settings;
    const auto show = [&](double done, const std::string& name) {
        work.estimate.advance(Part::frames, done);
        work.show("frame times, " + name);
    };
    DERMIS_TRY_ASSIGN(const std::vector<TechniqueCost> costs,
                      measure_costs(renderer, work.scene, contestants, settings.width, settings.height,
                                    settings.frames, show, work.hooks.stop));
    for (size_t i = 0; i < costs.size(); ++i) work.comparison.rows[i].cost = costs[i];
    work.estimate.set_left(Part::frames, 0);
    return {};
}

Result<void> judge_all(ComparisonWork& work) {
    Comparison& comparison = work.comparison;
    DERMIS_TRY(finish_references(work));
    DERMIS_TRY_ASSIGN(comparison.regions, find_regions(work.scene, comparison.masks.skin));
    comparison.reference_rmse = noise_rmse(comparison.reference, comparison.masks.skin);
    for (size_t i = 0; i < comparison.rows.size(); ++i) {
        work.estimate.advance(Part::judging, double(i) / double(comparison.rows.size()));
        work.show("errors of the pictures");
        DERMIS_TRY(judge(comparison, work.scene, comparison.rows[i]));
    }
    return {};
}

}  // namespace

Result<Comparison> compare_techniques(gpu::Device& device, const Catalog& catalog, const Scene& scene,
                                      const std::vector<Contestant>& contestants,
                                      const ComparisonSettings& settings, const ComparisonHooks& hooks) {
    DERMIS_TRY(check_comparison(scene, contestants, settings));
    // First, as it says at once what it cannot do.
    DERMIS_TRY_ASSIGN(Renderer renderer,
                      Renderer::create(device, gpu::embedded_shaders(catalog.shaders), scene));
    return compare_techniques(device, renderer, catalog, scene, contestants, settings, hooks);
}

Result<Comparison> compare_techniques(gpu::Device& device, Renderer& renderer, const Catalog& catalog,
                                      const Scene& scene, const std::vector<Contestant>& contestants,
                                      const ComparisonSettings& settings, const ComparisonHooks& hooks) {
    DERMIS_TRY(check_comparison(scene, contestants, settings));
    ComparisonSettings own = settings;
    own.reference.tracing = std::make_shared<SharedTracing>();
    ComparisonWork work{scene, own, hooks};
    work.comparison.device = device.info().name;
    guess_times(work, contestants.size());
    DERMIS_TRY(begin_comparison(device, renderer, catalog, contestants, work));
    DERMIS_TRY(time_techniques(renderer, contestants, work));
    for (const std::string& warning : renderer.warnings()) work.comparison.warnings.push_back(warning);
    DERMIS_TRY(make_unscattered(work, hooks.stop));
    DERMIS_TRY(refine_references(work, settings.noise));
    if (work.cancelled()) return Error{"stopped"};
    DERMIS_TRY(judge_all(work));
    return std::move(work.comparison);
}

}  // namespace dermis::inline judge
