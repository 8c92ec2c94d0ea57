#include "dermis/judge/effect_reference.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
#include "dermis/base/parallel.h"
#include "dermis/judge/cuts.h"
#include "dermis/judge/reference_cache.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"
#include "dermis/rays/camera_ray.h"
#include "dermis/rays/random.h"
#include "dermis/reference/effect_sampler.h"
#include "dermis/reference/materials.h"
#include "dermis/reference/picture_sums.h"

namespace dermis::inline judge {
namespace {

// Factor on the estimated number of samples, so that the wanted noise is not missed by a small amount.
constexpr double kMargin = 1.05;
// Samples of a half of each pixel before their spread is known.
constexpr int kFirstSamples = 1;
// The least part of a pixel in later samples, over the mean's: the spread around it may miss its own.
constexpr float kLeastWeight = 0.4f, kMostWeight = 4;

Result<std::string> state_hash(const Scene& scene, const ReferenceSettings& settings) {
    ReferenceSettings plain = settings;
    plain.samples = 0;
    DERMIS_TRY_ASSIGN(const std::string hash, reference_hash(scene, plain));
    return Hasher().add(std::string_view("effect")).add(hash).hex();
}

// The picture without scattering, for a half. It samples every cell of a pixel once; all cells together take
// about kLightPoints points on the lights.
Result<ReferencePicture> unscattered(const Scene& scene, const ReferenceSettings& effect, uint32_t half,
                                     const ReferenceProgress& progress, const std::atomic<bool>* stop) {
    constexpr int kLightPoints = 144;
    const int cells = effect.grid * effect.grid;
    const ReferenceSettings settings{.integrator = Integrator::lambert,
                                     .width = effect.width,
                                     .height = effect.height,
                                     .samples = std::max(cells, 2),
                                     .seed = hash_u32(effect.seed, half),
                                     .probes = std::max(kLightPoints / cells, 1),
                                     .cavities = effect.cavities,
                                     .filter = PixelFilter::grid,
                                     .grid = effect.grid,
                                     .lighting = effect.lighting,
                                     .tracing = effect.tracing};
    DERMIS_TRY_ASSIGN(CachedReference made, cached_reference(scene, settings, progress, stop));
    return std::move(made.picture);
}

Image whole_skin(const Image& skin) {
    Image mask = skin;
    for (float& v : mask.floats()) v = v >= 1 ? 1 : 0;
    return mask;
}

// Spread of the halves around each pixel, the pixel itself left out: root of the mean square of their
// difference over its 24 neighbours in the mask; 0 where there are none.
std::vector<float> spread_around(const EffectSamples& samples, const Image& mask) {
    constexpr int kReach = 2;
    const int width = mask.width, height = mask.height;
    std::vector<double> squares(mask.pixel_count());
    for (size_t i = 0; i < squares.size(); ++i)
        for (size_t c = 3 * i; c < 3 * i + 3; ++c)
            squares[i] += std::pow(double(samples.a.floats()[c]) - double(samples.b.floats()[c]), 2);
    std::vector<float> spread(squares.size());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double sum = 0, count = 0;
            for (int v = std::max(y - kReach, 0); v <= std::min(y + kReach, height - 1); ++v)
                for (int u = std::max(x - kReach, 0); u <= std::min(x + kReach, width - 1); ++u) {
                    const size_t other = size_t(v) * size_t(width) + size_t(u);
                    if ((u == x && v == y) || mask.floats()[other] <= 0) continue;
                    sum += squares[other];
                    ++count;
                }
            spread[size_t(y) * size_t(width) + size_t(x)] = count > 0 ? float(std::sqrt(sum / count)) : 0;
        }
    return spread;
}

// A pixel's part of the samples, over the mean's: as its spread (Neyman 1934), which gives the least mean
// square of the noise.
std::vector<float> sample_weights(const EffectSamples& samples, const Image& mask) {
    std::vector<float> weights = spread_around(samples, mask);
    const auto mean = [&] {
        double sum = 0, count = 0;
        for (size_t i = 0; i < weights.size(); ++i)
            if (mask.floats()[i] > 0) sum += weights[i], ++count;
        return float(sum / std::max(count, 1.0));
    };
    const float before = mean();
    for (float& w : weights) w = before > 0 ? std::clamp(w / before, kLeastWeight, kMostWeight) : 1;
    const float after = mean();
    for (float& w : weights) w /= after;
    return weights;
}

}  // namespace

Image EffectReference::radiance() const {
    Image mean = halves[0];
    for (size_t i = 0; i < mean.floats().size(); ++i)
        mean.floats()[i] = 0.5f * (halves[0].floats()[i] + halves[1].floats()[i]);
    return mean;
}

struct EffectReferenceMaker::Work {
    const Scene& scene;
    EffectReferenceSettings settings;
    std::string hash;
    Image shown;                                // the share of skin, beside cuts too
    Image mask;                                 // whole pixels of skin
    std::optional<EffectSampler> sampler;       // made when samples are
    std::array<Image, 2> unscattered_radiance;  // one a half; empty until make_unscattered()
    // What is stored.
    int passes = 0;  // samples of a half, in the mean of the mask
    double time_ms = 0;
    EffectSamples samples;
    std::vector<float> weights;
    EffectReference reference;

    Work(const Scene& of, const EffectReferenceSettings& s)
        : scene(of),
          settings(s),
          shown(s.reference.width, s.reference.height, 1),
          samples(s.reference.width, s.reference.height) {}

    [[nodiscard]] auto parts() {
        return std::tie(passes, time_ms, shown.bytes, samples.a.bytes, samples.b.bytes, samples.counts,
                        samples.walks, samples.lost_walks, samples.cut_channels, weights);
    }
    void load() {
        weights.resize(samples.counts.size());
        if (cache_load("effect", hash, parts())) return;
        passes = 0;
        time_ms = 0;
        samples = EffectSamples(shown.width, shown.height);
    }

    [[nodiscard]] Result<void> make_sampler() {
        if (sampler) return {};
        DERMIS_TRY_ASSIGN(EffectSampler made, EffectSampler::create(scene, settings.reference));
        sampler.emplace(std::move(made));
        return {};
    }

    // After load().
    [[nodiscard]] Result<void> find_skin() {
        if (passes == 0) {
            DERMIS_TRY(make_sampler());
            shown = sampler->skin();
        }
        reference.skin = shown;
        DERMIS_TRY_ASSIGN(const Image away, away_from_cuts(scene, shown.width, shown.height));
        for (size_t i = 0; i < away.pixel_count(); ++i) reference.skin.floats()[i] *= away.floats()[i];
        mask = whole_skin(reference.skin);
        if (std::ranges::none_of(mask.floats(), [](float v) { return v > 0; }))
            return Error{"no pixel shows skin: nothing to compare (see the scene's materials and camera)"};
        return {};
    }

    // Samples of each pixel's half when the mean has `mean`; a number by chance, which the pixel has for
    // ever, rounds them.
    [[nodiscard]] std::vector<uint32_t> counts_of(int mean) const {
        std::vector<uint32_t> counts(samples.counts.size());
        for (size_t i = 0; i < counts.size(); ++i) {
            if (shown.floats()[i] <= 0) continue;
            const float part = mean > kFirstSamples ? weights[i] : 1;
            const float rounding = unit_float(hash_u32(settings.reference.seed, uint32_t(i)));
            counts[i] = std::max(uint32_t(kFirstSamples), uint32_t(part * float(mean) + rounding));
        }
        return counts;
    }

    [[nodiscard]] Result<void> raise_to(int mean, const EffectReferenceHooks& hooks) {
        DERMIS_TRY(make_sampler());
        const auto start = std::chrono::steady_clock::now();
        const bool first = passes == 0;
        const double wanted = std::max(passes_wanted(), double(mean));
        const auto done = [&](double share) {
            if (!hooks.done) return;
            hooks.done(first ? share : (passes + share * (mean - passes)) / wanted, first);
        };
        const bool complete = sampler->raise(counts_of(mean), samples, done, hooks.stop);
        if (!complete && first) return stopped_without_a_picture();
        time_ms +=
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        if (complete) passes = mean;
        reference.stopped = !complete;
        if (first) weights = sample_weights(samples, mask);
        update();
        reference.from_cache = false;
        cache_store("effect", hash, parts());
        return {};
    }

    // The pictures without scattering, unless stopped.
    [[nodiscard]] Result<void> make_unscattered(const ReferenceProgress& progress,
                                                const std::atomic<bool>* stop) {
        for (uint32_t half = 0; half < 2; ++half) {
            if (!unscattered_radiance[half].bytes.empty()) continue;
            const auto done = [&](double share) {
                if (progress) progress((half + share) / 2);
            };
            Result<ReferencePicture> made = unscattered(scene, settings.reference, half, done, stop);
            if (stop && stop->load()) {
                reference.stopped = true;
                return {};
            }
            if (!made) return made.error();
            unscattered_radiance[half] = std::move(made->radiance);
        }
        return {};
    }

    void update() {
        reference.effect = {samples.a, samples.b};
        reference.noise = effect_noise(reference.effect, mask);
        reference.samples = 2 * passes;
        reference.time_ms = time_ms;
    }

    [[nodiscard]] bool is_fine_enough() const {
        return reference.noise.noise_rms <= settings.noise * reference.noise.effect_rms;
    }
    [[nodiscard]] int most_passes() const { return settings.samples / 2; }
    // By the noise now: the square falls as one over the work.
    [[nodiscard]] double passes_wanted() const {
        const auto [effect, noise] = reference.noise;
        if (effect <= 0) return most_passes();
        const double ratio = noise / (settings.noise * effect);
        return std::min(double(most_passes()), passes * ratio * ratio * (ratio > 1 ? kMargin : 1));
    }
    [[nodiscard]] int next_passes() const {
        const int half_more = passes + std::max(1, passes / 2);
        return std::min(std::max(passes + 1, int(std::ceil(passes_wanted()))),
                        std::min(half_more, most_passes()));
    }
};

EffectReferenceMaker::EffectReferenceMaker(std::unique_ptr<Work> work) : work_(std::move(work)) {}
EffectReferenceMaker::~EffectReferenceMaker() = default;
EffectReferenceMaker::EffectReferenceMaker(EffectReferenceMaker&&) noexcept = default;

Result<EffectReferenceMaker> EffectReferenceMaker::begin(const Scene& scene,
                                                         const EffectReferenceSettings& settings,
                                                         const EffectReferenceHooks& hooks) {
    if (settings.samples < 2 * kFirstSamples)
        return Error{"at most " + std::to_string(settings.samples) +
                     " samples a pixel: both halves of the reference need " +
                     std::to_string(2 * kFirstSamples)};
    auto work = std::make_unique<Work>(scene, settings);
    work->settings.reference.filter = PixelFilter::grid;
    work->settings.reference.noise = {};
    DERMIS_TRY_ASSIGN(work->hash, state_hash(scene, work->settings.reference));
    work->load();
    DERMIS_TRY(work->find_skin());
    work->reference.from_cache = true;
    DERMIS_TRY_ASSIGN(work->reference.warnings, walk_notes(scene, work->settings.reference));
    work->update();
    if (work->passes == 0) DERMIS_TRY(work->raise_to(kFirstSamples, hooks));
    return EffectReferenceMaker(std::move(work));
}

bool EffectReferenceMaker::is_done() const {
    return work_->reference.stopped || work_->is_fine_enough() || work_->passes >= work_->most_passes();
}

Result<void> EffectReferenceMaker::refine(const EffectReferenceHooks& hooks) {
    return work_->raise_to(work_->next_passes(), hooks);
}

Result<void> EffectReferenceMaker::make_unscattered(const ReferenceProgress& progress,
                                                    const std::atomic<bool>* stop) {
    return work_->make_unscattered(progress, stop);
}

const EffectReference& EffectReferenceMaker::so_far() const {
    return work_->reference;
}

double EffectReferenceMaker::noise_over_wanted() const {
    const EffectNoise& noise = work_->reference.noise;
    const double wanted = work_->settings.noise * noise.effect_rms;
    return wanted > 0 ? noise.noise_rms / wanted : std::numeric_limits<double>::infinity();
}

double EffectReferenceMaker::left_ms() const {
    if (is_done()) return 0;
    return work_->time_ms * std::max(work_->passes_wanted() / work_->passes - 1, 0.0);
}

Result<EffectReference> EffectReferenceMaker::finish() {
    Work& work = *work_;
    EffectReference made = work.reference;
    DERMIS_TRY(work.make_unscattered({}, nullptr));
    made.halves = work.unscattered_radiance;
    made.reached = work.is_fine_enough();
    made.stopped = !is_done() || made.stopped;
    for (size_t half = 0; half < 2; ++half) {
        const Image& effect = half == 0 ? made.effect.a : made.effect.b;
        for (size_t i = 0; i < effect.pixel_count(); ++i)
            for (size_t c = 0; c < 3; ++c)
                made.halves[half].floats()[4 * i + c] += effect.floats()[3 * i + c];
    }
    add_fault_warnings(work.samples.walks, work.samples.lost_walks, work.samples.cut_channels, made.warnings);
    return made;
}

Result<EffectReference> make_effect_reference(const Scene& scene, const EffectReferenceSettings& settings,
                                              const EffectReferenceHooks& hooks) {
    DERMIS_TRY_ASSIGN(EffectReferenceMaker maker, EffectReferenceMaker::begin(scene, settings, hooks));
    while (!maker.is_done()) DERMIS_TRY(maker.refine(hooks));
    return maker.finish();
}

Result<Image> exact_effect(const Scene& scene, const ExactExitance& exact, int width, int height, int grid,
                           float penumbra_mm) {
    DERMIS_TRY_ASSIGN(const Profile profile, find_profile(scene.skin.profile));
    DERMIS_TRY_ASSIGN(const RayScene rays, RayScene::build(scene.objects));
    DERMIS_TRY_ASSIGN(const MaterialSet materials, MaterialSet::load(scene));
    const GaussianSum gaussians = to_gaussian_sum(profile).sum;
    const Light& key = scene.key_light();
    const Vec3 light = key.color_linear * (key.intensity / std::numbers::pi_v<float>);
    const Mat4 inverse = camera_matrices(scene.camera, float(width) / float(height)).inverse_view_projection;
    const auto effect_at = [&](float x, float y) -> Vec3 {
        const auto hit = rays.closest_hit(RaySet::opaque, camera_ray(inverse, x, y, width, height));
        if (!hit) return {};
        const ShadingPoint point = materials.shade(rays.surface_at(*hit), *hit);
        if (point.material_class != MaterialClass::skin) return {};
        const ExactPoint value = exact(gaussians, penumbra_mm, point.p_mm);
        const Vec3 without = {value.irradiance, value.irradiance, value.irradiance};
        return point.albedo_linear * light * (value.exitance - without);
    };
    Image picture(width, height, 3);
    const float cell = 1 / float(grid);
    parallel_for(size_t(height), 1, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y)
            for (size_t x = 0; x < size_t(width); ++x) {
                Vec3 sum;
                for (int i = 0; i < grid * grid; ++i)
                    sum += effect_at(float(x) + (float(i % grid) + 0.5f) * cell,
                                     float(y) + (float(i / grid) + 0.5f) * cell);
                const Vec3 mean = sum * (cell * cell);
                const float channels[3] = {mean.x, mean.y, mean.z};
                std::copy_n(channels, 3, &picture.floats()[3 * (y * size_t(width) + x)]);
            }
    });
    return picture;
}

}  // namespace dermis::inline judge
