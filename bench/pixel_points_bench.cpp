// How many points of a pixel are enough: the captured shares of every technique with 16, 36 and 64 points;
// docs/figures.md has them.
//
//     build/bench/pixel_points_bench [SIZE] [NOISE] [SCENE...]     128 pixels, 0.08 of the effect, three
//     scenes
//
// Each number of points has its own reference, as in a comparison: maps are read at another level of
// detail too. References are kept in the cache.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "catalog/catalog.h"
#include "dermis/judge/comparison.h"
#include "dermis/judge/technique_pictures.h"
#include "dermis/render/complete_scene.h"
#include "dermis/scene/load_scene.h"

namespace {

using namespace dermis;

constexpr int kGrids[] = {4, 6, 8};

int fail(const std::string& message) {
    std::fprintf(stderr, "pixel_points_bench: %s\n", message.c_str());
    return 1;
}

Result<EffectReference> reference_of(const Scene& scene, int size, int grid, double noise) {
    const ComparisonSettings settings = comparison_settings(size, size);
    EffectReferenceSettings wanted{.reference = settings.reference, .noise = noise, .samples = 65536};
    wanted.reference.probes = settings.probes;
    wanted.reference.grid = grid;
    return make_effect_reference(scene, wanted);
}

PictureMaker maker_of(Renderer& renderer, int size, int grid) {
    const ComparisonSettings settings = comparison_settings(size, size);
    return {renderer,
            **find_technique(built_in_catalog().techniques, "lambert"),
            {.width = size,
             .height = size,
             .grid = grid,
             .shadow_map_size = settings.shadow_map_size,
             .penumbra_mm = settings.reference.lighting.penumbra_mm}};
}

// One number of points: the shares of all techniques.
Result<std::vector<CapturedShare>> shares_of(Renderer& renderer, const Scene& scene,
                                             std::span<const Contestant> contestants, int size, int grid,
                                             double noise) {
    const Result<EffectReference> reference = reference_of(scene, size, grid, noise);
    if (!reference) return reference.error();
    PictureMaker maker = maker_of(renderer, size, grid);
    const Result<SkinMasks> masks = maker.masks(reference->skin);
    if (!masks) return masks.error();
    std::vector<CapturedShare> shares;
    for (const Contestant& contestant : contestants) {
        const Result<TechniquePictures> pictures = maker.make(contestant);
        if (!pictures) return pictures.error();
        const Result<Captured> share = captured(pictures->effect, reference->effect, masks->skin);
        if (!share) return share.error();
        shares.push_back(share->all);
    }
    return shares;
}

void print_difference(const CapturedShare& a, const CapturedShare& b) {
    std::printf(" %+.3f ± %.3f |", b.share - a.share, std::hypot(a.error, b.error));
}

Result<void> print_scene(gpu::Device& device, const std::string& name, int size, double noise) {
    Result<Scene> scene = load_scene(name, {.subjects = built_in_catalog().subjects});
    if (!scene) return scene.error();
    if (Result<void> complete = complete_scene(*scene); !complete) return complete;
    Result<Renderer> renderer =
        Renderer::create(device, gpu::embedded_shaders(built_in_catalog().shaders), *scene);
    if (!renderer) return renderer.error();
    std::vector<Contestant> contestants = default_contestants(built_in_catalog().techniques);
    std::erase_if(contestants, [](const Contestant& c) {  // what does not scatter
        return c.technique->id == "lambert" || c.technique->id == "oren_nayar";
    });
    std::vector<std::vector<CapturedShare>> shares;
    for (const int grid : kGrids) {
        Result<std::vector<CapturedShare>> found =
            shares_of(*renderer, *scene, contestants, size, grid, noise);
        if (!found) return found.error();
        shares.push_back(std::move(*found));
    }
    for (size_t i = 0; i < contestants.size(); ++i) {
        std::printf("| %s | `%s` |", name.c_str(), contestants[i].name().c_str());
        for (const auto& own : shares) std::printf(" %.3f |", own[i].share);
        for (size_t k = 1; k < shares.size(); ++k) print_difference(shares[k - 1][i], shares[k][i]);
        std::printf("\n");
    }
    return {};
}

}  // namespace

int main(int argc, char** argv) {
    const int size = argc > 1 ? std::atoi(argv[1]) : 128;
    const double noise = argc > 2 ? std::atof(argv[2]) : 0.08;
    if (size < 16 || size > 1024) return fail("a size of 16 to 1024");
    if (!(noise > 0 && noise <= 1)) return fail("a noise above 0, at most 1");
    std::vector<std::string> names(argv + std::min(argc, 3), argv + argc);
    if (names.empty()) names = {"spheres", "bust", "head_scan"};
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    Result<gpu::Device> device = gpu::Device::create({});
    if (!device) return fail(device.error().message);
    std::printf(
        "| scene | technique | 16 | 36 | 64 | 16 to 36 | 36 to 64 |\n|---|---|---|---|---|---|---|\n");
    for (const std::string& name : names)
        if (Result<void> printed = print_scene(*device, name, size, noise); !printed)
            return fail(name + ": " + printed.error().message);
}
