// Noise and processor time of the effect of scattering by a reference, as `dermis compare` makes it: two
// halves of 36 samples a pixel, each less its picture without scattering. The last number compares versions
// and settings: the time that a noise of 0.2 of the effect would take, if the square fell as one over the
// time.
//
//     build/bench/reference_bench [SCENE[/PROFILE]] [SIZE] [PROBES] [surface|walk]

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "catalog/catalog.h"
#include "dermis/judge/comparison.h"
#include "dermis/render/complete_scene.h"
#include "dermis/scene/load_scene.h"

namespace {

using namespace dermis;

int fail(const std::string& message) {
    std::fprintf(stderr, "reference_bench: %s\n", message.c_str());
    return 1;
}

double processor_s() {
    return double(std::clock()) / CLOCKS_PER_SEC;
}

struct Half {
    Image effect, skin;
};

Result<Half> make_half(const Scene& scene, ReferenceSettings settings) {
    DERMIS_TRY_ASSIGN(const ReferencePicture with, render_reference(scene, settings));
    settings.integrator = Integrator::lambert;
    DERMIS_TRY_ASSIGN(const ReferencePicture without, render_reference(scene, settings));
    return Half{difference(with.diffuse, without.diffuse), with.skin};
}

ReferenceSettings settings_of(int size, int probes, Integrator integrator) {
    const ComparisonSettings comparison = comparison_settings(size, size);
    ReferenceSettings settings = comparison.reference;
    settings.noise = {};
    settings.filter = PixelFilter::grid;
    settings.grid = comparison.grid;
    settings.samples = settings.grid * settings.grid;
    settings.integrator = integrator;
    settings.probes = probes > 0                       ? probes
                      : integrator == Integrator::walk ? comparison.walks
                                                       : comparison.probes;
    return settings;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string name = argc > 1 ? argv[1] : "head_scan";
    const int size = argc > 2 ? std::atoi(argv[2]) : 128;
    const Integrator integrator =
        argc > 4 && std::string(argv[4]) == "walk" ? Integrator::walk : Integrator::surface;
    ReferenceSettings settings = settings_of(size, argc > 3 ? std::atoi(argv[3]) : 0, integrator);
    const size_t slash = name.find('/');
    Result<Scene> scene = load_scene(name.substr(0, slash), {.subjects = built_in_catalog().subjects});
    if (!scene) return fail(scene.error().message);
    if (slash != std::string::npos) scene->skin.profile = name.substr(slash + 1);
    if (Result<void> complete = complete_scene(*scene); !complete) return fail(complete.error().message);
    const double start = processor_s();
    const Result<Half> a = make_half(*scene, settings);
    if (!a) return fail(a.error().message);
    settings.seed = 2;
    const Result<Half> b = make_half(*scene, settings);
    if (!b) return fail(b.error().message);
    const double time_s = processor_s() - start;
    Image whole = a->skin;
    for (float& v : whole.floats()) v = v >= 1 ? 1 : 0;
    const EffectNoise noise = effect_noise({a->effect, b->effect}, whole);
    const double ratio = noise.noise_rms / noise.effect_rms;
    std::printf("%s, %d x %d, %d probes: noise %.3f of the effect, %.1f s; %.1f s for 0.2\n", name.c_str(),
                size, size, settings.probes, ratio, time_s, time_s * ratio * ratio / 0.04);
}
