// The cost of a frame that moves beside one that does not: a mesh file with a clip, posed on the processor as
// `dermis view` does while it plays, and drawn with preintegrated. Medians over frames in one run; quote
// ratios.
//
//     build/bench/motion_bench MESH.glb [FRAMES] [SIZE of a side]

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "catalog/catalog.h"
#include "dermis/mesh/tension.h"
#include "dermis/render/complete_scene.h"
#include "dermis/render/renderer.h"
#include "dermis/scene/load_scene.h"
#include "dermis/scene/pose_scene.h"

namespace {

using namespace dermis;
using Clock = std::chrono::steady_clock;

template <class Work>
void time_ms(std::vector<double>& times_ms, const Work& work) {
    const Clock::time_point start = Clock::now();
    if (const Result<void> done = work(); !done) {
        std::fprintf(stderr, "motion_bench: %s\n", done.error().message.c_str());
        std::exit(1);
    }
    times_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

Result<void> run(const std::string& mesh, int frames, int side) {
    Scene scene;
    std::vector<double> load, still, pose, tension, upload, moving;
    time_ms(load, [&]() -> Result<void> {
        DERMIS_TRY_ASSIGN(scene, load_scene(mesh, {}));
        return complete_scene(scene);
    });
    if (scene.objects.empty() || scene.objects[0].motion.clips.empty()) return Error{mesh + ": has no clip"};
    const ClipInfo clip = scene.objects[0].motion.clips.back();
    DERMIS_TRY_ASSIGN(gpu::Device device, gpu::Device::create({}));
    DERMIS_TRY_ASSIGN(Renderer renderer,
                      Renderer::create(device, gpu::embedded_shaders(built_in_catalog().shaders), scene));
    DERMIS_TRY_ASSIGN(const Technique* technique,
                      find_technique(built_in_catalog().techniques, "preintegrated"));
    const ParameterValues values(technique->parameters);
    const auto draw = [&]() -> Result<void> {
        const auto drawn = renderer.draw(*technique, values, {.width = side, .height = side});
        return drawn ? Result<void>() : drawn.error();
    };
    DERMIS_TRY_ASSIGN(const ScenePoser poser, ScenePoser::create(scene));
    const Mesh& moved = scene.objects[0].mesh;
    const RestAreas areas = rest_areas(moved);
    DERMIS_TRY(draw());
    for (int frame = 0; frame < frames; ++frame) {
        const double time_s = clip.length_s * (frame + 1) / frames;
        time_ms(still, draw);
        time_ms(pose, [&] { return poser.pose({.clip = clip.name, .time_s = time_s}, scene); });
        time_ms(tension, [&]() -> Result<void> {
            const auto tensions = compute_tensions(areas, moved.positions_mm, moved.indices);
            return tensions == moved.tensions ? Result<void>() : Error{"the pose has another tension"};
        });
        time_ms(upload, [&] { return renderer.vertices_moved(); });
        time_ms(moving, draw);
    }
    const double posed_ms = median(pose) + median(upload);
    std::printf("%s, clip %s, %d x %d, %s, %zu vertices\n", mesh.c_str(), clip.name.c_str(), side, side,
                device.info().name.c_str(), scene.objects[0].mesh.positions_mm.size());
    std::printf(
        "load %.0f ms, drawing %.1f ms, pose %.1f ms (of it tension %.2f ms), upload %.1f ms, drawing after "
        "it "
        "%.1f ms\n",
        load[0], median(still), median(pose), median(tension), median(upload), median(moving));
    std::printf("moving / still: %.2f\n", (posed_ms + median(moving)) / median(still));
    return {};
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "motion_bench MESH.glb [FRAMES] [SIZE]\n");
        return 2;
    }
    const Result<void> done =
        run(argv[1], argc > 2 ? std::atoi(argv[2]) : 21, argc > 3 ? std::atoi(argv[3]) : 512);
    if (!done) std::fprintf(stderr, "motion_bench: %s\n", done.error().message.c_str());
    return done ? 0 : 1;
}
