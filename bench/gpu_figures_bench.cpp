// The model of `dermis cost` beside times measured on a device: a Markdown table. Run it by
// tools/gpu_figures.
//
//     build/bench/gpu_figures_bench [SCENE] [WIDTHxHEIGHT] [FRAMES] [CHIP] [DEVICE]
//
// Model over measured is stated only for a GPU: a rasteriser on the CPU says nothing of a card.

#include <cstdio>
#include <cstdlib>
#include <string>

#include "catalog/catalog.h"
#include "dermis/judge/technique_cost.h"
#include "dermis/render/complete_scene.h"
#include "dermis/report/ratios.h"
#include "dermis/scene/load_scene.h"

namespace {

using namespace dermis;

int fail(const std::string& message) {
    std::fprintf(stderr, "gpu_figures: %s\n", message.c_str());
    return 1;
}

struct Options {
    std::string scene = "head_scan", chip = "navi21", device;
    int width = 1920, height = 1080, frames = 20;
};

Result<Options> options_of(const std::vector<std::string>& words) {
    Options options;
    if (words.size() > 0) options.scene = words[0];
    if (words.size() > 1 && std::sscanf(words[1].c_str(), "%dx%d", &options.width, &options.height) != 2)
        return Error{"'" + words[1] + "' is no WIDTHxHEIGHT"};
    if (options.width < 16 || options.height < 16 || options.width > 16384 || options.height > 16384)
        return Error{"a size of 16x16 to 16384x16384"};
    if (words.size() > 2) options.frames = std::atoi(words[2].c_str());
    if (options.frames < 1 || options.frames > 10000) return Error{"1 to 10000 frames"};
    if (words.size() > 3) options.chip = words[3];
    if (words.size() > 4) options.device = words[4];
    return options;
}

void print_heading(const Options& options, const Card& card, const gpu::DeviceInfo& device,
                   const std::string& credit) {
    std::printf(
        "`%s`, %d x %d, median of %d frames after the first, measured on %s (%s); the model is of a "
        "%s (%s).\n",
        options.scene.c_str(), options.width, options.height, options.frames, device.name.c_str(),
        device.driver.c_str(), std::string(card.name).c_str(), std::string(card.chip).c_str());
    if (device.is_cpu)
        std::printf(
            "The device is a rasteriser on the CPU: its times are those of no card, so that model over "
            "measured is left out.\n");
    else if (device.name.find(card.name) == std::string::npos)
        std::printf(
            "The model is of another card than the device: model over measured holds for this pair "
            "alone.\n");
    if (!credit.empty()) std::printf("Scene: %s\n", credit.c_str());
    std::printf(
        "\n| technique | model, ms | measured, ms | model / measured | model, x lambert | measured, x "
        "lambert |\n|---|---|---|---|---|---|\n");
}

Result<void> print_figures(const Options& options) {
    const Result<const Card*> card = find_card(options.chip);
    if (!card) return card.error();
    Result<Scene> scene = load_scene(options.scene, {.subjects = built_in_catalog().subjects});
    if (!scene) return scene.error();
    if (Result<void> complete = complete_scene(*scene); !complete) return complete;
    Result<gpu::Device> device = gpu::Device::create({.name_contains = options.device});
    if (!device) return device.error();
    const std::vector<Contestant> contestants = default_contestants(built_in_catalog().techniques);
    const Result<std::vector<double>> models = model_times_ms(
        *device, built_in_catalog(), *scene, contestants, options.width, options.height, **card);
    if (!models) return models.error();
    Result<Renderer> renderer =
        Renderer::create(*device, gpu::embedded_shaders(built_in_catalog().shaders), *scene);
    if (!renderer) return renderer.error();
    const auto measured =
        measure_costs(*renderer, *scene, contestants, options.width, options.height, options.frames);
    if (!measured) return measured.error();

    print_heading(options, **card, device->info(), scene->credit);
    for (size_t i = 0; i < contestants.size(); ++i) {
        const double model_ms = (*models)[i], time_ms = (*measured)[i].time_ms;
        char over[16] = "";
        if (!device->info().is_cpu) std::snprintf(over, sizeof over, "%.2f", model_ms / time_ms);
        // lambert comes first (default_contestants).
        std::printf("| `%s` | %.3f | %.3f | %s | %.2f | %.2f |\n", contestants[i].name().c_str(), model_ms,
                    time_ms, over, model_ms / (*models)[0], (*measured)[i].time_ratio);
    }
    return {};
}

}  // namespace

int main(int argc, char** argv) {
    const Result<Options> options = options_of({argv + 1, argv + argc});
    if (!options) return fail(options.error().message);
    const Result<void> done = print_figures(*options);
    return done ? 0 : fail(done.error().message);
}
