#include "dermis/judge/effect_reference.h"

#include <algorithm>
#include <cmath>
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
#include "dermis/reference/materials.h"

namespace dermis::inline judge {
namespace {

// Rounds over the grid in one batch at most: what a run that is stopped loses.
constexpr int kMostRounds = 8;
// Factor on the estimated number of passes, so that the wanted noise is not missed by a small amount.
constexpr double kMargin = 1.05;

struct State {
    int passes = 0;  // a half
    uint32_t batches = 0;
    EffectReference reference;
    Image away;  // from cuts

    explicit State(const ReferenceSettings& s) {
        reference.effect = {Image(s.width, s.height, 3), Image(s.width, s.height, 3)};
        reference.halves = {Image(s.width, s.height, 4), Image(s.width, s.height, 4)};
        reference.skin = Image(s.width, s.height, 1);
    }
    // What is stored.
    [[nodiscard]] auto parts() {
        return std::tie(passes, batches, reference.time_ms, reference.effect.a.bytes,
                        reference.effect.b.bytes, reference.halves[0].bytes, reference.halves[1].bytes,
                        reference.skin.bytes, reference.warnings);
    }
};

Result<std::string> state_hash(const Scene& scene, const ReferenceSettings& settings) {
    ReferenceSettings plain = settings;
    plain.samples = settings.grid * settings.grid;
    DERMIS_TRY_ASSIGN(const std::string hash, reference_hash(scene, plain));
    return Hasher().add(std::string_view("effect")).add(hash).hex();
}

void add_weighted(Image& mean, const Image& value, float share) {
    for (size_t i = 0; i < mean.floats().size(); ++i)
        mean.floats()[i] += (value.floats()[i] - mean.floats()[i]) * share;
}

// One batch of both widths goes to one half.
Result<void> add_batch(const Scene& scene, ReferenceSettings settings, int half, State& state,
                       const ReferenceProgress& progress, const std::atomic<bool>* stop) {
    settings.seed = hash_u32(settings.seed, state.batches);
    // Width 0 takes a small part of the time.
    const Result<ReferencePicture> skin = render_reference(scene, settings, progress, stop);
    if (!skin) return skin.error();
    settings.integrator = Integrator::lambert;
    DERMIS_TRY_ASSIGN(const ReferencePicture none, render_reference(scene, settings, {}, stop));
    if (stop && stop->load()) return Error{"stopped"};
    const float share = float(settings.samples) / float(state.passes + settings.samples);
    add_weighted(half == 0 ? state.reference.effect.a : state.reference.effect.b,
                 difference(skin->diffuse, none.diffuse), share);
    add_weighted(state.reference.halves[size_t(half)], skin->radiance, share);
    state.reference.skin = skin->skin;
    if (!state.away.empty())
        for (size_t i = 0; i < state.away.pixel_count(); ++i)
            state.reference.skin.floats()[i] *= state.away.floats()[i];
    state.reference.time_ms += skin->time_ms + none.time_ms;
    ++state.batches;
    for (const std::string& warning : skin->warnings)
        if (std::ranges::find(state.reference.warnings, warning) == state.reference.warnings.end())
            state.reference.warnings.push_back(warning);
    return {};
}

Image whole_skin(const Image& skin) {
    Image mask = skin;
    for (float& v : mask.floats()) v = v >= 1 ? 1 : 0;
    return mask;
}

// Passes a half that the wanted noise takes, by what it is now: the square falls as one over the work.
double passes_wanted(const State& state, const EffectReferenceSettings& settings) {
    const EffectNoise& now = state.reference.noise;
    const double most = settings.samples / 2.0;
    if (now.effect_rms <= 0) return most;
    const double ratio = now.noise_rms / (settings.noise * now.effect_rms);
    return std::min(most, state.passes * ratio * ratio * (ratio > 1 ? kMargin : 1));
}

bool fine_enough(const State& state, const EffectReferenceSettings& settings) {
    return state.passes > 0 &&
           state.reference.noise.noise_rms <= settings.noise * state.reference.noise.effect_rms;
}

// The next batch of a half, in passes: whole rounds over the grid; 0 when the limit leaves none.
int next_passes(const State& state, const EffectReferenceSettings& settings) {
    const int cells = settings.reference.grid * settings.reference.grid;
    // The cache may hold a finer reference, of a run with a higher limit.
    const int left = std::max(0, settings.samples / 2 - state.passes) / cells;
    if (state.passes == 0) return cells * std::min(left, 1);
    const double wanted = (passes_wanted(state, settings) - state.passes) / cells;
    return cells * std::min({left, kMostRounds, std::max(1, int(std::ceil(wanted)))});
}

// A batch of both halves, or none of it.
Result<void> refine(const Scene& scene, const ReferenceSettings& reference,
                    const EffectReferenceSettings& settings, const EffectReferenceHooks& hooks,
                    State& state) {
    State next = state;
    next.reference.from_cache = false;
    for (int half = 0; half < 2; ++half) {
        const auto done = [&](double share) {
            if (!hooks.done) return;
            const bool first = state.passes == 0;
            const double passes = state.passes + (half + share) / 2 * reference.samples;
            const double wanted = first ? reference.samples : passes_wanted(state, settings);
            hooks.done(std::min(1.0, passes / std::max(wanted, 1.0)), first);
        };
        DERMIS_TRY(add_batch(scene, reference, half, next, done, hooks.stop));
    }
    next.passes += reference.samples;
    next.reference.samples = 2 * next.passes;
    const Image mask = whole_skin(next.reference.skin);
    if (std::ranges::none_of(mask.floats(), [](float v) { return v > 0; }))
        return Error{"no pixel shows skin: nothing to compare (see the scene's materials and camera)"};
    next.reference.noise = effect_noise(next.reference.effect, mask);
    state = std::move(next);
    return {};
}

}  // namespace

Image EffectReference::radiance() const {
    Image mean = halves[0];
    for (size_t i = 0; i < mean.floats().size(); ++i)
        mean.floats()[i] = 0.5f * (halves[0].floats()[i] + halves[1].floats()[i]);
    return mean;
}

Result<EffectReference> make_effect_reference(const Scene& scene, const EffectReferenceSettings& settings,
                                              const EffectReferenceHooks& hooks) {
    ReferenceSettings reference = settings.reference;
    reference.filter = PixelFilter::grid;
    reference.noise = {};
    const int cells = reference.grid * reference.grid;
    if (settings.samples < 2 * cells)
        return Error{"at most " + std::to_string(settings.samples) +
                     " samples a pixel: both halves of the reference need " + std::to_string(2 * cells)};
    DERMIS_TRY_ASSIGN(const std::string hash, state_hash(scene, reference));
    State state(reference);
    if (cache_load("effect", hash, state.parts()))
        state.reference.noise = effect_noise(state.reference.effect, whole_skin(state.reference.skin));
    else
        state = State(reference);
    DERMIS_TRY_ASSIGN(state.away, away_from_cuts(scene, reference.width, reference.height));
    state.reference.samples = 2 * state.passes;
    state.reference.from_cache = true;
    while (!fine_enough(state, settings)) {
        reference.samples = next_passes(state, settings);
        if (reference.samples == 0) break;
        const Result<void> refined = refine(scene, reference, settings, hooks, state);
        state.reference.stopped = hooks.stop && hooks.stop->load();
        if (!refined && (!state.reference.stopped || state.passes == 0)) return refined.error();
        if (!refined) break;
        cache_store("effect", hash, state.parts());
        if (hooks.refined) hooks.refined(state.reference);
    }
    state.reference.reached = fine_enough(state, settings);
    return std::move(state.reference);
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
