// Noise and time of the effect of scattering by a reference, as `dermis compare` makes it. The last
// number compares versions and settings: the time that the noise which compare asks for would take, if the
// square fell as one over the time.
//
//     build/bench/reference_bench [SCENE[/PROFILE]] [SIZE] [PROBES] [surface|walk] [SAMPLES]

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>
#include <string>

#include "catalog/catalog.h"
#include "dermis/judge/comparison.h"
#include "dermis/render/complete_scene.h"
#include "dermis/scene/load_scene.h"

namespace {

using namespace dermis;

constexpr double kNoNoise = 1e-9;
const double kWantedNoise = ComparisonSettings{}.noise;

int fail(const std::string& message) {
    std::fprintf(stderr, "reference_bench: %s\n", message.c_str());
    return 1;
}

double processor_s() {
    return double(std::clock()) / CLOCKS_PER_SEC;
}

EffectReferenceSettings settings_of(int size, int probes, Integrator integrator, int samples) {
    const ComparisonSettings comparison = comparison_settings(size, size);
    EffectReferenceSettings settings{
        .reference = comparison.reference, .noise = kNoNoise, .samples = samples};
    settings.reference.grid = comparison.grid;
    settings.reference.integrator = integrator;
    settings.reference.probes = probes > 0                       ? probes
                                : integrator == Integrator::walk ? comparison.walks
                                                                 : comparison.probes;
    settings.reference.seed = std::random_device()();  // nothing comes from the cache
    return settings;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string name = argc > 1 ? argv[1] : "head_scan";
    const int size = argc > 2 ? std::atoi(argv[2]) : 128;
    const Integrator integrator =
        argc > 4 && std::string(argv[4]) == "walk" ? Integrator::walk : Integrator::surface;
    const EffectReferenceSettings settings =
        settings_of(size, argc > 3 ? std::atoi(argv[3]) : 0, integrator, argc > 5 ? std::atoi(argv[5]) : 16);
    const size_t slash = name.find('/');
    Result<Scene> scene = load_scene(name.substr(0, slash), {.subjects = built_in_catalog().subjects});
    if (!scene) return fail(scene.error().message);
    if (slash != std::string::npos) scene->skin.profile = name.substr(slash + 1);
    if (Result<void> complete = complete_scene(*scene); !complete) return fail(complete.error().message);
    const double start = processor_s();
    const Result<EffectReference> made = make_effect_reference(*scene, settings);
    if (!made) return fail(made.error().message);
    const double time_s = processor_s() - start, ratio = made->noise.noise_rms / made->noise.effect_rms;
    std::printf(
        "%s, %d x %d, %d samples of %d probes: noise %.3f of the effect, %.1f s of processor time; samples "
        "%.1f s, %.1f s for %.1f\n",
        name.c_str(), size, size, made->samples, settings.reference.probes, ratio, time_s,
        made->time_ms * 1e-3, made->time_ms * 1e-3 * ratio * ratio / (kWantedNoise * kWantedNoise),
        kWantedNoise);
}
