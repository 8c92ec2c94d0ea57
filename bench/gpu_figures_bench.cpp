// The model of `dermis cost` beside times measured on a device: a Markdown table. Run it by
// tools/gpu_figures.
//
//     build/bench/gpu_figures_bench [SCENE] [WIDTHxHEIGHT] [FRAMES] [CHIP or none] [DEVICE]
//
// `none` leaves the model out: it needs Mesa's RADV. Model over measured is stated only for a GPU: a
// rasteriser on the CPU says nothing of a card.

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

void print_measured_on(const Options& options, const gpu::DeviceInfo& device, const std::string& credit) {
    std::printf("`%s`, %d x %d, median of %d frames after the first, measured on %s (%s).\n",
                options.scene.c_str(), options.width, options.height, options.frames, device.name.c_str(),
                device.driver.c_str());
    if (!credit.empty()) std::printf("Scene: %s\n", credit.c_str());
}

void print_model_of(const Card& card, const gpu::DeviceInfo& device) {
    std::printf("The model is of a %s (%s).\n", std::string(card.name).c_str(),
                std::string(card.chip).c_str());
    if (device.is_cpu)
        std::printf(
            "The device is a rasteriser on the CPU: its times are those of no card, so that model over "
            "measured is left out.\n");
    else if (device.name.find(card.name) == std::string::npos)
        std::printf(
            "The model is of another card than the device: model over measured holds for this pair "
            "alone.\n");
    std::printf(
        "\n| technique | model, ms | measured, ms | model / measured | model, x lambert | measured, x "
        "lambert |\n|---|---|---|---|---|---|\n");
}

using Costs = std::vector<TechniqueCost>;

void print_measured(const std::vector<Contestant>& contestants, const Costs& measured) {
    std::printf("\n| technique | measured, ms | measured, x lambert |\n|---|---|---|\n");
    for (size_t i = 0; i < contestants.size(); ++i)
        std::printf("| `%s` | %.3f | %.2f |\n", contestants[i].name().c_str(), measured[i].time_ms,
                    measured[i].time_ratio);
}

void print_with_models(const std::vector<Contestant>& contestants, const Costs& measured,
                       const std::vector<double>& models, bool is_cpu) {
    for (size_t i = 0; i < contestants.size(); ++i) {
        char over[16] = "";
        if (!is_cpu) std::snprintf(over, sizeof over, "%.2f", models[i] / measured[i].time_ms);
        // lambert comes first (default_contestants).
        std::printf("| `%s` | %.3f | %.3f | %s | %.2f | %.2f |\n", contestants[i].name().c_str(), models[i],
                    measured[i].time_ms, over, models[i] / models[0], measured[i].time_ratio);
    }
}

Result<void> print_figures(const Options& options) {
    const bool has_model = options.chip != "none";
    const Card* card = nullptr;
    if (has_model) {
        const Result<const Card*> found = find_card(options.chip);
        if (!found) return found.error();
        card = *found;
    }
    Result<Scene> scene = load_scene(options.scene, {.subjects = built_in_catalog().subjects});
    if (!scene) return scene.error();
    if (Result<void> complete = complete_scene(*scene); !complete) return complete;
    Result<gpu::Device> device = gpu::Device::create({.name_contains = options.device});
    if (!device) return device.error();
    const std::vector<Contestant> contestants = default_contestants(built_in_catalog().techniques);
    std::vector<double> models;
    if (has_model) {
        Result<std::vector<double>> modelled = model_times_ms(
            *device, built_in_catalog(), *scene, contestants, options.width, options.height, *card);
        if (!modelled) return modelled.error();
        models = std::move(*modelled);
    }
    Result<Renderer> renderer =
        Renderer::create(*device, gpu::embedded_shaders(built_in_catalog().shaders), *scene);
    if (!renderer) return renderer.error();
    const auto measured =
        measure_costs(*renderer, *scene, contestants, options.width, options.height, options.frames);
    if (!measured) return measured.error();

    print_measured_on(options, device->info(), scene->credit);
    if (!has_model) {
        print_measured(contestants, *measured);
        return {};
    }
    print_model_of(*card, device->info());
    print_with_models(contestants, *measured, models, device->info().is_cpu);
    return {};
}

}  // namespace

int main(int argc, char** argv) {
    const Result<Options> options = options_of({argv + 1, argv + argc});
    if (!options) return fail(options.error().message);
    const Result<void> done = print_figures(*options);
    return done ? 0 : fail(done.error().message);
}
