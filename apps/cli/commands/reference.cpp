// `dermis reference`: the reference of a scene as a layered EXR.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "dermis/base/hash.h"
#include "dermis/base/progress.h"
#include "dermis/base/text.h"
#include "dermis/jobs/part.h"
#include "dermis/judge/reference_version.h"
#include "picture_text.h"
#include "reference_options.h"
#include "stop_on_signals.h"

namespace dermis::cli {
namespace {

// Exit status: the picture is written, but noisier than asked for.
constexpr int kNoiseMissed = 3;

// A progress line over calls with the share that is done.
template <class Work>
auto with_progress(Work work) {
    constexpr double kSteps = 1000;
    Progress line("reference", size_t(kSteps));
    size_t shown = 0;
    return work([&](double done) {
        const auto now = size_t(done * kSteps);
        if (now > shown) line.advance(now - shown);
        shown = std::max(shown, now);
    });
}

// The words of the command line that all parts have in common.
std::vector<std::string> common_words(const std::vector<std::string>& words) {
    constexpr std::string_view kOptions[] = {"-o", "--output", "--sample-range", "--preview"};
    constexpr std::string_view kFlags[] = {"--json"};
    return words_without(words, kOptions, kFlags);
}

std::string command_of(const std::vector<std::string>& words) {
    std::string command = "dermis";
    for (const std::string& word : common_words(words)) command += " " + shell_word(word);
    return command;
}

Result<int> run_part(const ReferenceOptions& options, const ReferenceSettings& settings, const Scene& scene,
                     SampleRange range, const std::vector<std::string>& words) {
    const Result<std::string> content = content_hash(scene, settings);
    if (!content) return content.error();
    const auto start = std::chrono::steady_clock::now();
    const Result<PictureSums> sums = with_progress([&](const ReferenceProgress& progress) {
        return sum_samples(scene, settings, range, progress, &stop_requested());
    });
    if (!sums && stop_requested()) {
        print_message(sums.error().message);
        return stopped_exit_code();
    }
    if (!sums) return sums.error();
    if (Result<void> written = write_part(options.output,
                                          {.picture = options.facts(settings, scene),
                                           .version = std::string(reference_version()),
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
        std::printf("%s: samples %d:%d of 0:%d, %.1f s\n", printable_line(options.output).c_str(),
                    range.begin, range.end, settings.samples, seconds);
    return 0;
}

Result<int> run_picture(const ReferenceOptions& options, const ReferenceSettings& settings,
                        const Scene& scene) {
    DERMIS_TRY_ASSIGN(const ReferencePicture picture, with_progress([&](const ReferenceProgress& progress) {
                          return render_reference(scene, settings, progress, &stop_requested());
                      }));
    const PictureFacts facts = options.facts(settings, scene);
    const std::string text = described(facts, picture, stop_requested());
    DERMIS_TRY(write_picture_file(options.output, facts, picture, text));
    if (!options.preview.empty()) DERMIS_TRY(write_preview_file(options.preview, facts, picture));
    print_picture({.output = options.output,
                   .text = text,
                   .credit = scene.credit,
                   .json = options.json,
                   .stopped = stop_requested()},
                  picture);
    if (stop_requested()) return stopped_exit_code();
    if (picture.reached_noise) return 0;
    std::fprintf(stderr,
                 "dermis: the relative error is %.4f after %d samples a pixel, not the %g of --noise: raise "
                 "--samples\n",
                 picture.relative_error, picture.passes, options.noise);
    return kNoiseMissed;
}

Result<int> run(const ReferenceOptions& options, const std::vector<std::string>& words) {
    DERMIS_TRY_ASSIGN(const ReferenceSettings settings, options.settings());
    DERMIS_TRY_ASSIGN(const std::optional<SampleRange> range, options.range(settings));
    DERMIS_TRY_ASSIGN(const Scene scene, options.load_scene());
    const StopOnSignals stop;  // until the files are written
    return range ? run_part(options, settings, scene, *range, words) : run_picture(options, settings, scene);
}

// Ranges of whole blocks, as equal as they can be.
std::vector<SampleRange> split_samples(int samples, int parts) {
    const int blocks = samples / kSampleBlock;
    parts = std::min(parts, blocks);
    std::vector<SampleRange> ranges;
    for (int i = 0; i < parts; ++i)
        ranges.push_back({blocks * i / parts * kSampleBlock, blocks * (i + 1) / parts * kSampleBlock});
    return ranges;
}

Result<JobPlan> plan(const ReferenceOptions& options, const std::vector<std::string>& words, int parts,
                     const std::string& folder) {
    DERMIS_TRY_ASSIGN(const ReferenceSettings settings, options.settings());
    if (!options.sample_range.empty())
        return Error{"--sample-range: dermis jobs chooses the ranges; leave it out"};
    DERMIS_TRY(check_range(settings, {0, settings.samples}));
    DERMIS_TRY_ASSIGN(const Scene scene, options.load_scene());
    DERMIS_TRY_ASSIGN(const std::string content, content_hash(scene, settings));
    const PictureFacts facts = options.facts(settings, scene);
    const std::string hash = Hasher()
                                 .add(content)
                                 .add(settings.samples)
                                 .add(facts.description)
                                 .add(facts.tone_map)
                                 .add(facts.exposure_ev)
                                 .add(facts.credit)
                                 .hex();
    JobPlan plan;
    Job merge{.name = options.output, .hash = hash, .words = {"merge"}, .results = {options.output}};
    for (const SampleRange range : split_samples(settings.samples, parts)) {
        const std::string text = std::to_string(range.begin) + ":" + std::to_string(range.end);
        const std::string file = folder + "/parts/" + hash + "_" + std::to_string(range.begin) + "_" +
                                 std::to_string(range.end) + ".exr";
        Job job{.name = options.output + " samples " + text,
                .hash = hash,
                .words = common_words(words),
                .results = {file},
                .is_part = true};
        job.words.insert(job.words.end(), {"--sample-range", text, "-o", file});
        plan.work.push_back(std::move(job));
        merge.words.push_back(file);
    }
    merge.words.insert(merge.words.end(), {"-o", options.output});
    if (!options.preview.empty()) {
        merge.words.insert(merge.words.end(), {"--preview", options.preview});
        merge.results.push_back(options.preview);
    }
    plan.merge = std::move(merge);
    return plan;
}

}  // namespace

void add_reference_command(CommandLine& line) {
    auto options = std::make_shared<ReferenceOptions>();
    Command* command = line.add(
        "reference", "Renders the reference of a scene: surface integral of the profile, or random walks",
        "dermis reference head_scan -o reference.exr --noise 0.01\n"
        "  dermis reference head_scan --integrator walk --samples 256 -o walk.exr\n"
        "  dermis reference head_scan --samples 64 --sample-range 0:16 -o part.exr\n"
        "  layers: R,G,B,A radiance and coverage; diffuse; specular; variance of the mean; samples; skin\n"
        "  Ctrl-C (or SIGTERM, SIGHUP) writes the picture so far and prints its error\n"
        "  exit code 3: the picture is written, but --samples ended it before --noise was reached");
    options->add_to(*command);
    line.when_chosen(
        command, [options] { return options->files(); },
        [options, &line] { return run(*options, line.words); },
        [options, &line](int parts, const std::string& folder) {
            return plan(*options, line.words, parts, folder);
        });
}

}  // namespace dermis::cli
