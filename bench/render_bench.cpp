// The cost of a frame: every technique on the bust, which every machine has, or another scene, at 1024 x
// 1024, MSAA 1, shadow and environment on; medians over frames in one run, the first left out. Ratios to
// lambert are what to quote; absolute times belong to the machine.
//
//     build/bench/render_bench [SCENE] [FRAMES]

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "dermis/render/complete_scene.h"
#include "dermis/render/renderer.h"

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

}  // namespace

int main(int argc, char** argv) {
    const std::string name = argc > 1 ? argv[1] : "bust";
    const int frames = argc > 2 ? std::max(2, std::atoi(argv[2])) : 8;
    const auto start = Clock::now();
    Result<Scene> scene = load_scene(name);
    if (!scene) return fail(scene.error().message);
    if (const auto completed = complete_scene(*scene); !completed) return fail(completed.error().message);
    const double load_ms = since_ms(start);
    Result<gpu::Device> device = gpu::Device::create({});
    if (!device) return fail(device.error().message);
    Result<Renderer> renderer = Renderer::create(*device, gpu::embedded_shaders(), *scene);
    if (!renderer) return fail(renderer.error().message);
    std::printf(
        "%s, 1024x1024, %d frames after the first, on %s\nscene %.0f ms, ready to draw after %.0f ms\n",
        scene->name.c_str(), frames - 1, device->info().name.c_str(), load_ms, since_ms(start));

    double lambert_ms = 0;
    std::vector<const Technique*> order = {*find_technique("lambert")};
    for (const Technique& technique : all_techniques())
        if (technique.id != "lambert") order.push_back(&technique);
    for (const Technique* technique : order) {
        const ParameterValues values(technique->parameters);
        std::vector<gpu::FrameResult> results;
        for (int frame = 0; frame < frames; ++frame) {
            Result<gpu::FrameResult> drawn = renderer->draw(*technique, values, {.frame_index = frame});
            if (!drawn) return fail(drawn.error().message);
            if (frame > 0) results.push_back(std::move(*drawn));
        }
        std::vector<double> totals;
        for (const gpu::FrameResult& result : results) totals.push_back(result.frame_ms);
        const double frame_ms = median(totals);
        if (technique->id == "lambert") lambert_ms = frame_ms;
        std::printf("%-20s %9.2f ms  %.2f x lambert\n", technique->id.c_str(), frame_ms,
                    frame_ms / lambert_ms);
        for (size_t pass = 0; pass < results[0].passes.size(); ++pass) {
            std::vector<double> times;
            for (const gpu::FrameResult& result : results) times.push_back(result.passes[pass].time_ms);
            std::printf("    %-20s %9.2f ms\n", results[0].passes[pass].name.c_str(), median(times));
        }
    }
}
