// The cost of a frame: every technique on the bust, which every machine has, or another scene, at 1024 x
// 1024, MSAA 1, shadow and environment on; medians over frames in one run, the first left out. Quote ratios
// to lambert; absolute times depend on the machine.
//
//     build/bench/render_bench [SCENE] [FRAMES] [TECHNIQUE, beside lambert] [SIZE of a side]
//
// `defaults` as the technique: every technique with its defaults alone, as bench/versions reads them.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "catalog/catalog.h"
#include "dermis/render/complete_scene.h"
#include "dermis/render/renderer.h"
#include "dermis/scene/load_scene.h"

namespace {

using namespace dermis;
using Clock = std::chrono::steady_clock;

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

int fail(const std::string& message) {
    std::fprintf(stderr, "render_bench: %s\n", message.c_str());
    return 1;
}

double since_ms(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct Run {
    std::string name;
    const Technique* technique;
    ParameterValues values;
};

Run run_of(const std::string& id, const std::string& parameter = "", const std::string& value = "") {
    const Technique* technique = *find_technique(built_in_catalog().techniques, id);
    Run run = {value.empty() ? id : id + " " + value, technique, ParameterValues(technique->parameters)};
    if (!value.empty() && !run.values.set(parameter, value)) std::abort();  // from the list below
    return run;
}

const std::string kDefaults = "defaults";

// Lambert, then every technique (or one) with its presets, those that have transmission without it too, and
// the settings of preintegrated and spherical_gaussians whose costs their READMEs state.
std::vector<Run> runs(const std::string& only) {
    std::vector<Run> all = {run_of("lambert")};
    for (const Technique& technique : built_in_catalog().techniques) {
        if (technique.id == "lambert") continue;
        if (!only.empty() && only != kDefaults && technique.id != only) continue;
        all.push_back(run_of(technique.id));
        if (only == kDefaults) continue;
        Run without = run_of(technique.id);
        without.name += " transmission=none";
        if (without.values.set("transmission", "none")) all.push_back(std::move(without));
        if (technique.id == "spherical_gaussians")
            for (const char* lobes : {"1", "6"}) all.push_back(run_of(technique.id, "lobes", lobes));
        for (const ParameterPreset& preset : technique.parameters.presets)
            if (preset.name != "default") all.push_back(run_of(technique.id, "preset", preset.name));
        if (technique.id != "preintegrated") continue;
        all.push_back(run_of(technique.id, "diffuse", "closed_form"));
        all.push_back(run_of(technique.id, "normals", "sharp"));
        all.push_back(run_of(technique.id, "shadow", "plain"));
        all.push_back(run_of(technique.id, "shadow", "scattered"));
    }
    return all;
}

// Medians over frames. cpu_ms is the time all threads of this process worked, which on lavapipe is the cost
// of a frame independent of other work on the machine; on a GPU it is the driver's part only.
struct Cost {
    double frame_ms = 0, cpu_ms = 0;
    std::vector<std::pair<std::string, double>> passes;
};

Result<Cost> measure(Renderer& renderer, const Run& run, int frames, int side) {
    std::vector<gpu::FrameResult> results;
    std::vector<double> totals, cpu;
    for (int frame = 0; frame < frames; ++frame) {
        const std::clock_t before = std::clock();
        Result<gpu::FrameResult> drawn =
            renderer.draw(*run.technique, run.values, {.width = side, .height = side});
        if (!drawn) return drawn.error();
        if (frame == 0) continue;  // compiles
        cpu.push_back(double(std::clock() - before) * 1e3 / CLOCKS_PER_SEC);
        totals.push_back(drawn->frame_ms);
        results.push_back(std::move(*drawn));
    }
    Cost cost = {.frame_ms = median(totals), .cpu_ms = median(cpu)};
    for (size_t pass = 0; pass < results[0].passes.size(); ++pass) {
        std::vector<double> times;
        for (const gpu::FrameResult& result : results) times.push_back(result.passes[pass].time_ms);
        cost.passes.emplace_back(results[0].passes[pass].name, median(times));
    }
    return cost;
}

void print(const Run& run, const Cost& cost, double lambert_ms, double lambert_cpu_ms) {
    std::printf("%-28s %9.2f ms  %.2f x lambert    cpu %9.2f ms  %.2f x lambert\n", run.name.c_str(),
                cost.frame_ms, cost.frame_ms / lambert_ms, cost.cpu_ms, cost.cpu_ms / lambert_cpu_ms);
    for (const auto& [name, time_ms] : cost.passes)
        std::printf("    %-20s %9.2f ms\n", name.c_str(), time_ms);
}

}  // namespace

int main(int argc, char** argv) {
    const std::string name = argc > 1 ? argv[1] : "bust";
    const int frames = argc > 2 ? std::max(2, std::atoi(argv[2])) : 8;
    const std::string only = argc > 3 ? argv[3] : "";
    const int side = argc > 4 ? std::max(1, std::atoi(argv[4])) : 1024;
    const auto start = Clock::now();
    Result<Scene> scene = load_scene(name, {.subjects = built_in_catalog().subjects});
    if (!scene) return fail(scene.error().message);
    if (const auto completed = complete_scene(*scene); !completed) return fail(completed.error().message);
    const double load_ms = since_ms(start);
    Result<gpu::Device> device = gpu::Device::create({});
    if (!device) return fail(device.error().message);
    Result<Renderer> renderer =
        Renderer::create(*device, gpu::embedded_shaders(built_in_catalog().shaders), *scene);
    if (!renderer) return fail(renderer.error().message);
    std::printf("%s, %dx%d, %d frames after the first, on %s\nscene %.0f ms, ready to draw after %.0f ms\n",
                scene->name.c_str(), side, side, frames - 1, device->info().name.c_str(), load_ms,
                since_ms(start));

    double lambert_ms = 0, lambert_cpu_ms = 0;
    for (const Run& run : runs(only)) {
        const Result<Cost> cost = measure(*renderer, run, frames, side);
        if (!cost) return fail(cost.error().message);
        if (lambert_ms == 0) lambert_ms = cost->frame_ms, lambert_cpu_ms = cost->cpu_ms;
        print(run, *cost, lambert_ms, lambert_cpu_ms);
    }
}
