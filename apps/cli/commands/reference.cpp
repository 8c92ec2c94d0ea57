// `dermis reference`: the ground truth of a scene as a layered EXR.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "dermis/base/file.h"
#include "dermis/base/progress.h"
#include "dermis/base/text.h"
#include "dermis/image/io.h"
#include "dermis/image/tone_map.h"
#include "dermis/reference/picture.h"
#include "dermis/render/complete_scene.h"
#include "reference_options.h"

namespace dermis::cli {
namespace {

// Exit status: the picture is written, but noisier than asked for.
constexpr int kNoiseMissed = 3;

using SignalHandler = void (*)(int);

std::atomic<int> g_signal = 0;
std::atomic<bool> g_stop = false;
std::atomic<int64_t> g_stopped_ms = 0;
SignalHandler g_interrupt_before = SIG_DFL, g_terminate_before = SIG_DFL;

// Ctrl-C or a request to end. The first signal ends the passes, the picture so far is written, then the
// program ends; one that comes later ends the program at once. `timeout`, make and shells send the same
// signal twice, to the process and to its group: what comes within a second is the first one again.
extern "C" void stop_on_signal(int signal) {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    const int64_t now_ms = int64_t(now.tv_sec) * 1000 + now.tv_nsec / 1'000'000;
    if (!g_stop) {
        g_signal = signal;
        g_stopped_ms = now_ms;
        g_stop = true;
    } else if (now_ms > g_stopped_ms + 1000) {
        std::signal(signal, signal == SIGINT ? g_interrupt_before : g_terminate_before);
        std::raise(signal);
    }
}

// While an object exists, the first signal only sets g_stop.
class StopOnSignals {
  public:
    StopOnSignals() {
        g_interrupt_before = std::signal(SIGINT, stop_on_signal);
        g_terminate_before = std::signal(SIGTERM, stop_on_signal);
    }
    ~StopOnSignals() {
        std::signal(SIGINT, g_interrupt_before);
        std::signal(SIGTERM, g_terminate_before);
    }
    StopOnSignals(const StopOnSignals&) = delete;
    StopOnSignals& operator=(const StopOnSignals&) = delete;
};

// Before the work, not after it.
Result<void> try_outputs(const ReferenceOptions& options) {
    if (to_lower(std::filesystem::path(options.output).extension().string()) != ".exr")
        return Error{"-o " + options.output + ": the ground truth is linear and layered; name a .exr file"};
    if (Result<void> tried = try_output(options.output); !tried) return tried;
    if (options.preview.empty()) return {};
    const std::string extension = std::filesystem::path(options.preview).extension().string();
    if (const auto encoded = encode_image(extension, Image(1, 1, 3, PixelFormat::u8, Encoding::srgb), {});
        !encoded)
        return Error{"--preview " + options.preview + ": " + encoded.error().message};
    return try_output(options.preview);
}

Result<Scene> scene_of(const ReferenceOptions& options) {
    Result<Scene> scene = options.scene.load();
    if (!scene) return scene;
    // The renderer's approximation needs the vertices' occlusion.
    if (options.ambient == "renderer")
        if (Result<void> completed = complete_scene(*scene); !completed) return completed.error();
    if (!options.profile.empty()) scene->skin.profile = options.profile;
    return scene;
}

nlohmann::ordered_json description(const ReferenceOptions& options, const ReferenceSettings& settings,
                                   const ReferencePicture& picture, bool stopped) {
    return {{"scene", options.scene.name},
            {"integrator", options.integrator},
            {"width", settings.width},
            {"height", settings.height},
            {"passes", picture.passes},
            {"probes", settings.probes},
            {"seed", settings.seed},
            {"filter", options.filter},
            {"shadows", options.shadows},
            {"ambient", options.ambient},
            {"specular", options.specular},
            {"normalisation", options.normalisation},
            {"cavities", options.cavities},
            {"width_scale", settings.width_scale},
            {"penumbra_mm", options.penumbra_mm},
            {"relative_error", picture.relative_error},
            {"noise_reached", picture.reached_noise},
            {"stopped", stopped},
            {"warnings", picture.warnings}};
}

Result<void> write_picture(const ReferenceOptions& options, const Scene& scene,
                           const ReferencePicture& picture, const std::string& text) {
    const ImageLayer layers[] = {{"", picture.radiance},         {"diffuse", picture.diffuse},
                                 {"specular", picture.specular}, {"variance", picture.variance},
                                 {"samples", picture.samples},   {"skin", picture.skin}};
    ImageText inside = {{"dermis", text}};
    if (!scene.credit.empty()) inside["credit"] = scene.credit;
    return write_layered_exr(options.output, layers, inside);
}

// For display: the scene's exposure and tone map, 8 bits.
Result<void> write_preview(const ReferenceOptions& options, const Scene& scene,
                           const ReferencePicture& picture) {
    if (options.preview.empty()) return {};
    const Image shown = tone_mapped(picture.radiance, scene.tone_map, std::exp2(scene.exposure_ev));
    Image opaque(shown.width, shown.height, 3);
    for (size_t i = 0; i < opaque.pixel_count(); ++i)
        std::copy_n(&shown.floats()[4 * i], 3, &opaque.floats()[3 * i]);
    const ImageText text = scene.credit.empty() ? ImageText{} : ImageText{{"credit", scene.credit}};
    return write_image(options.preview, convert(opaque, PixelFormat::u8, Encoding::srgb), text);
}

Result<int> run(const ReferenceOptions& options) {
    const Result<ReferenceSettings> settings = options.settings();
    if (!settings) return settings.error();
    if (Result<void> tried = try_outputs(options); !tried) return tried.error();
    const Result<Scene> scene = scene_of(options);
    if (!scene) return scene.error();
    const StopOnSignals stop;  // until the files are written
    Result<ReferencePicture> picture = [&] {
        constexpr double kSteps = 1000;
        Progress line("ground truth", size_t(kSteps));
        size_t shown = 0;
        return render_reference(
            *scene, *settings,
            [&](double done) {
                const auto now = size_t(done * kSteps);
                if (now > shown) line.advance(now - shown);
                shown = std::max(shown, now);
            },
            &g_stop);
    }();
    if (!picture) return picture.error();
    picture->warnings.insert(picture->warnings.begin(), scene->warnings.begin(), scene->warnings.end());
    nlohmann::ordered_json json = description(options, *settings, *picture, g_stop);
    if (Result<void> written = write_picture(options, *scene, *picture, json.dump()); !written)
        return written.error();
    json["time_ms"] = picture->time_ms;  // not in the file: the same seed gives the same bytes
    if (Result<void> written = write_preview(options, *scene, *picture); !written) return written.error();
    for (const std::string& warning : picture->warnings) print_warning(warning);
    if (options.json)
        std::printf("%s\n", json.dump(2).c_str());
    else
        std::printf("%s: %s%d passes, relative error %.4f, %.1f s%s%s\n", options.output.c_str(),
                    g_stop ? "stopped after " : "", picture->passes, picture->relative_error,
                    picture->time_ms / 1000, scene->credit.empty() ? "" : "\n", scene->credit.c_str());
    if (g_stop) return 128 + g_signal;
    if (picture->reached_noise) return 0;
    std::fprintf(stderr,
                 "dermis: the relative error is %.4f after %d samples a pixel, not the %g of --noise: raise "
                 "--samples\n",
                 picture->relative_error, picture->passes, options.noise);
    return kNoiseMissed;
}

}  // namespace

void add_reference_command(CommandLine& line) {
    auto options = std::make_shared<ReferenceOptions>();
    Command* command = line.add(
        "reference", "Renders the ground truth of a scene: surface integral of the profile, or random walks",
        "dermis reference head_scan -o truth.exr --noise 0.01\n"
        "  dermis reference head_scan --integrator walk --profile jensen_skin1 --samples 256 -o walk.exr\n"
        "  layers: R,G,B,A radiance and coverage; diffuse; specular; variance of the mean; samples; skin\n"
        "  Ctrl-C (or SIGTERM) writes the picture so far and prints its error\n"
        "  exit code 3: the picture is written, but --samples ended it before --noise was reached");
    options->add_to(*command);
    line.when_chosen(command, [options] { return run(*options); });
}

}  // namespace dermis::cli
