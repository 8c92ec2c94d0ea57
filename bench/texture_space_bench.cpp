// The cost of lighting the skin in its atlas: time of each pass at light maps of 512, 1024 and 2048, as
// ratios to lambert's frame of the same run, with and without the culls. Medians over frames, the first left
// out.
//
//     build/bench/texture_space_bench [SCENE] [FRAMES]

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "catalog/catalog.h"
#include "dermis/render/complete_scene.h"
#include "dermis/render/renderer.h"
#include "dermis/scene/load_scene.h"

namespace {

using namespace dermis;
using Settings = std::vector<std::pair<std::string, std::string>>;

const DrawSettings kDraw = {.width = 1024, .height = 1024};

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

int fail(const std::string& message) {
    std::fprintf(stderr, "texture_space_bench: %s\n", message.c_str());
    return 1;
}

Result<std::vector<gpu::FrameResult>> draw_frames(Renderer& renderer, const std::string& id,
                                                  const Settings& settings, int frames) {
    const Result<const Technique*> technique = find_technique(built_in_catalog().techniques, id);
    if (!technique) return technique.error();
    ParameterValues values((*technique)->parameters);
    for (const auto& [name, text] : settings)
        if (Result<void> set = values.set(name, text); !set) return set.error();
    std::vector<gpu::FrameResult> results;
    for (int frame = 0; frame < frames; ++frame) {
        Result<gpu::FrameResult> drawn = renderer.draw(**technique, values, kDraw);
        if (!drawn) return drawn.error();
        if (frame > 0) results.push_back(std::move(*drawn));
    }
    return results;
}

double median_frame_ms(const std::vector<gpu::FrameResult>& results) {
    std::vector<double> totals;
    for (const gpu::FrameResult& result : results) totals.push_back(result.frame_ms);
    return median(totals);
}

void print(const std::string& label, const std::vector<gpu::FrameResult>& results, double lambert_ms) {
    std::printf("%-44s %6.2f x lambert\n", label.c_str(), median_frame_ms(results) / lambert_ms);
    for (size_t pass = 0; pass < results[0].passes.size(); ++pass) {
        std::vector<double> times;
        for (const gpu::FrameResult& result : results) times.push_back(result.passes[pass].time_ms);
        const gpu::PassTiming& timing = results[0].passes[pass];
        std::printf("    %-28s %7.3f", timing.name.c_str(), median(times) / lambert_ms);
        if (timing.samples_passed)
            std::printf("  %5.1f %% of its texels",
                        100.0 * double(timing.samples_passed) / double(timing.target_texels));
        std::printf("\n");
    }
}

}  // namespace

int main(int argc, char** argv) {
    const std::string name = argc > 1 ? argv[1] : "head_scan";
    const int frames = argc > 2 ? std::max(2, std::atoi(argv[2])) : 6;
    Result<Scene> scene = load_scene(name, {.subjects = built_in_catalog().subjects});
    if (!scene && argc < 2) scene = load_scene("bust", {.subjects = built_in_catalog().subjects});
    if (!scene) return fail(scene.error().message);
    if (const auto completed = complete_scene(*scene); !completed) return fail(completed.error().message);
    Result<gpu::Device> device = gpu::Device::create({});
    if (!device) return fail(device.error().message);
    Result<Renderer> renderer =
        Renderer::create(*device, gpu::embedded_shaders(built_in_catalog().shaders), *scene);
    if (!renderer) return fail(renderer.error().message);

    const auto lambert = draw_frames(*renderer, "lambert", {}, frames);
    if (!lambert) return fail(lambert.error().message);
    const double lambert_ms = median_frame_ms(*lambert);
    std::printf("%s, %dx%d, %d frames after the first, on %s\nlambert %.1f ms; all else as ratios to it\n",
                scene->name.c_str(), kDraw.width, kDraw.height, frames - 1, device->info().name.c_str(),
                lambert_ms);
    const Settings whole = {{"cull", "none"}};
    for (const char* size : {"512", "1024", "2048"}) {
        const std::pair<std::string, std::pair<std::string, Settings>> runs[] = {
            {"texture_space", {"texture_space", {}}},
            {"texture_space, no culls", {"texture_space", whole}},
            {"texture_space, the source's", {"texture_space", {{"preset", "source"}}}},
            {"texture_space_gaussians", {"texture_space_gaussians", {}}},
            {"texture_space_gaussians, no culls", {"texture_space_gaussians", whole}}};
        for (const auto& [label, run] : runs) {
            Settings settings = run.second;
            settings.emplace_back("light_map_size", size);
            const auto results = draw_frames(*renderer, run.first, settings, frames);
            if (!results) return fail(results.error().message);
            print(label + ", light map " + size, *results, lambert_ms);
        }
    }
}
