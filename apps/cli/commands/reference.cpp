// `dermis reference`: the ground truth of a scene as a layered EXR.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "dermis/base/progress.h"
#include "dermis/jobs/part.h"
#include "dermis/judge/truth_version.h"
#include "picture_text.h"
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

// A progress line over calls with the share that is done.
template <class Work>
auto with_progress(Work work) {
    constexpr double kSteps = 1000;
    Progress line("ground truth", size_t(kSteps));
    size_t shown = 0;
    return work([&](double done) {
        const auto now = size_t(done * kSteps);
        if (now > shown) line.advance(now - shown);
        shown = std::max(shown, now);
    });
}

// The shell line without output and range.
std::string command_of(const std::vector<std::string>& words) {
    std::string command = "dermis";
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        const bool with_value = word == "-o" || word == "--output" || word == "--sample-range";
        if (with_value) ++i;
        if (with_value || word == "--json" || word.starts_with("--output=") ||
            word.starts_with("--sample-range="))
            continue;
        command += " " + shell_word(word);
    }
    return command;
}

Result<int> run_part(const ReferenceOptions& options, const ReferenceSettings& settings, const Scene& scene,
                     SampleRange range, const std::vector<std::string>& words) {
    const Result<std::string> content = content_hash(scene, settings);
    if (!content) return content.error();
    const auto start = std::chrono::steady_clock::now();
    const Result<PictureSums> sums = with_progress([&](const ReferenceProgress& progress) {
        return sum_samples(scene, settings, range, progress, &g_stop);
    });
    if (!sums && g_stop) {
        print_message(sums.error().message);
        return 128 + g_signal;
    }
    if (!sums) return sums.error();
    if (Result<void> written = write_part(options.output,
                                          {.picture = options.facts(settings, scene),
                                           .version = std::string(truth_version()),
                                           .content = *content,
                                           .command = command_of(words),
                                           .range = range,
                                           .samples = settings.samples},
                                          *sums);
        !written)
        return written.error();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (options.json)
        std::printf("%s\n", nlohmann::ordered_json{{"output", options.output},
                                                   {"begin", range.begin},
                                                   {"end", range.end},
                                                   {"samples", settings.samples},
                                                   {"content", *content},
                                                   {"time_ms", seconds * 1000}}
                                .dump(2)
                                .c_str());
    else
        std::printf("%s: samples %d:%d of 0:%d, %.1f s\n", options.output.c_str(), range.begin, range.end,
                    settings.samples, seconds);
    return 0;
}

Result<int> run_picture(const ReferenceOptions& options, const ReferenceSettings& settings,
                        const Scene& scene) {
    const Result<ReferencePicture> picture = with_progress([&](const ReferenceProgress& progress) {
        return render_reference(scene, settings, progress, &g_stop);
    });
    if (!picture) return picture.error();
    const PictureFacts facts = options.facts(settings, scene);
    const std::string text = described(facts, *picture, g_stop);
    if (Result<void> written = write_picture_file(options.output, facts, *picture, text); !written)
        return written.error();
    if (!options.preview.empty())
        if (Result<void> written = write_preview_file(options.preview, facts, *picture); !written)
            return written.error();
    print_picture({.output = options.output,
                   .text = text,
                   .credit = scene.credit,
                   .json = options.json,
                   .stopped = g_stop},
                  *picture);
    if (g_stop) return 128 + g_signal;
    if (picture->reached_noise) return 0;
    std::fprintf(stderr,
                 "dermis: the relative error is %.4f after %d samples a pixel, not the %g of --noise: raise "
                 "--samples\n",
                 picture->relative_error, picture->passes, options.noise);
    return kNoiseMissed;
}

Result<int> run(const ReferenceOptions& options, const std::vector<std::string>& words) {
    const Result<ReferenceSettings> settings = options.settings();
    if (!settings) return settings.error();
    const Result<std::optional<SampleRange>> range = options.range(*settings);
    if (!range) return range.error();
    if (Result<void> tried = try_picture_files(options.output, options.preview); !tried) return tried.error();
    const Result<Scene> scene = options.load_scene();
    if (!scene) return scene.error();
    const StopOnSignals stop;  // until the files are written
    return *range ? run_part(options, *settings, *scene, **range, words)
                  : run_picture(options, *settings, *scene);
}

}  // namespace

void add_reference_command(CommandLine& line) {
    auto options = std::make_shared<ReferenceOptions>();
    Command* command = line.add(
        "reference", "Renders the ground truth of a scene: surface integral of the profile, or random walks",
        "dermis reference head_scan -o truth.exr --noise 0.01\n"
        "  dermis reference head_scan --integrator walk --profile jensen_skin1 --samples 256 -o walk.exr\n"
        "  dermis reference head_scan --samples 64 --sample-range 0:16 -o part.exr   (see dermis merge)\n"
        "  layers: R,G,B,A radiance and coverage; diffuse; specular; variance of the mean; samples; skin\n"
        "  Ctrl-C (or SIGTERM) writes the picture so far and prints its error\n"
        "  exit code 3: the picture is written, but --samples ended it before --noise was reached");
    options->add_to(*command);
    line.when_chosen(command, [options, &line] { return run(*options, line.words); });
}

}  // namespace dermis::cli
