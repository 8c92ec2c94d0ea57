// The cost of a frame that moves: a scene whose first mesh has a clip, posed on the CPU with an upload, and
// on the device as `dermis view` does while it plays, beside a frame of lambert and one of preintegrated.
// Medians over frames in one run; quote ratios.
//
//     build/bench/motion_bench SCENE_OR_MESH [FRAMES] [SIZE of a side]

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "catalog/catalog.h"
#include "dermis/render/complete_scene.h"
#include "dermis/render/renderer.h"
#include "dermis/scene/load_scene.h"
#include "dermis/scene/pose_scene.h"

namespace {

using namespace dermis;
using Clock = std::chrono::steady_clock;

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values.empty() ? 0 : values[values.size() / 2];
}

class MotionBench {
  public:
    Result<void> run(const std::string& path, int frames, int side) {
        DERMIS_TRY_ASSIGN(scene_, load_scene(path, {}));
        DERMIS_TRY(complete_scene(scene_));
        if (scene_.objects.empty() || scene_.objects[0].motion.clips.empty())
            return Error{path + ": has no clip"};
        const ClipInfo clip = scene_.objects[0].motion.clips.back();
        DERMIS_TRY_ASSIGN(gpu::Device device, gpu::Device::create({}));
        DERMIS_TRY_ASSIGN(
            Renderer renderer,
            Renderer::create(device, gpu::embedded_shaders(built_in_catalog().shaders), scene_));
        DERMIS_TRY_ASSIGN(const ScenePoser poser, ScenePoser::create(scene_));
        for (int frame = 0; frame <= frames; ++frame) {
            if (frame == 1) times_.clear();  // the first compiles and bakes
            const Pose pose = {.clip = clip.name, .time_s = clip.length_s * frame / std::max(frames, 1)};
            DERMIS_TRY(time("pose on the CPU", [&] { return poser.pose(pose, scene_); }));
            DERMIS_TRY(time("upload", [&] { return renderer.vertices_moved(); }));
            DERMIS_TRY(draw(renderer, "lambert", side));
            DERMIS_TRY(draw(renderer, "preintegrated", side));
            DERMIS_TRY(time("pose on the device, with its wait", [&]() -> Result<void> {
                DERMIS_TRY_ASSIGN(const bool posed, renderer.pose_on_device(poser, pose));
                return posed ? device.finish() : Error{path + ": only the CPU can pose it"};
            }));
            DERMIS_TRY_ASSIGN(const std::vector<gpu::FrameResult> done, renderer.deformer()->finished());
            for (const gpu::FrameResult& result : done) note(result);
        }
        print(path, side, device.info().name);
        return {};
    }

  private:
    template <class Work>
    Result<void> time(const std::string& name, const Work& work) {
        const Clock::time_point start = Clock::now();
        const Result<void> done = work();
        times_[name].push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
        return done;
    }

    void note(const gpu::FrameResult& result) {
        times_["passes of the pose"].push_back(result.frame_ms);
        for (const gpu::PassTiming& pass : result.passes) times_["  " + pass.name].push_back(pass.time_ms);
    }

    Result<void> draw(Renderer& renderer, const std::string& id, int side) {
        DERMIS_TRY_ASSIGN(const Technique* technique, find_technique(built_in_catalog().techniques, id));
        return time("frame of " + id, [&]() -> Result<void> {
            const auto drawn = renderer.draw(*technique, ParameterValues(technique->parameters),
                                             {.width = side, .height = side});
            return drawn ? Result<void>() : drawn.error();
        });
    }

    void print(const std::string& path, int side, const std::string& device) {
        size_t vertices = 0;
        for (const SceneObject& object : scene_.objects) vertices += object.mesh.positions_mm.size();
        std::printf("%s, %zu vertices, %d x %d, %s\n", path.c_str(), vertices, side, side, device.c_str());
        const double lambert = median(times_["frame of lambert"]);
        for (const auto& [name, all] : times_)
            std::printf("%-36s %8.2f ms %7.1f %% of lambert's frame\n", name.c_str(), median(all),
                        100 * median(all) / lambert);
    }

    Scene scene_;
    std::map<std::string, std::vector<double>> times_;
};

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "motion_bench SCENE_OR_MESH [FRAMES] [SIZE]\n");
        return 2;
    }
    const Result<void> done =
        MotionBench().run(argv[1], argc > 2 ? std::atoi(argv[2]) : 21, argc > 3 ? std::atoi(argv[3]) : 512);
    if (!done) std::fprintf(stderr, "motion_bench: %s\n", done.error().message.c_str());
    return done ? 0 : 1;
}
