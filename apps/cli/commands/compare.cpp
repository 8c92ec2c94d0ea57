// dermis compare: techniques compared with the reference, as a page and a table.

#include <fmt/core.h>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "catalog/catalog.h"
#include "clip_comparison.h"
#include "command.h"
#include "compare_options.h"
#include "compare_scenes.h"
#include "compare_text.h"
#include "comparison_progress.h"
#include "dermis/base/file.h"
#include "dermis/base/hash.h"
#include "dermis/judge/comparison.h"
#include "dermis/judge/report.h"
#include "job_hash.h"
#include "stop_on_signals.h"

namespace dermis::cli {
namespace {

namespace fs = std::filesystem;

struct CompareOptions {
    CompareChoice choice;
    std::string output, frame_range;
    bool json = false;
};

Result<FileUse> files_of(const CompareOptions& options) {
    const fs::path directory = options.output;
    std::error_code ec;
    if (fs::exists(directory, ec) && !fs::is_directory(directory, ec))
        return Error{"-o " + directory.string() + ": is a file; name a directory for the report"};
    FileUse files{.outputs = {directory / "report.html", directory / "scores.csv", directory / "regions.csv"},
                  .inputs = {options.choice.scene.name}};
    for (const std::string& text : options.choice.pictures)
        if (const Result<OwnPictureFiles> picture = parse_own_picture(text)) {
            files.inputs.push_back(picture->with);
            files.inputs.push_back(picture->without);
        }
    return files;
}

// report.html in the directory; for a set, one per scene in a folder of its own.
fs::path report_path(const CompareOptions& options, const ComparedScenes& scenes, const SubjectCase& one) {
    const fs::path directory(options.output);
    return scenes.is_set ? directory / fs::path(one.name).filename() / "report.html"
                         : directory / "report.html";
}

Result<Comparison> compare(gpu::Device& device, const SubjectCase& one, const std::string& prefix,
                           const std::vector<Contestant>& contestants, const ComparisonSettings& settings) {
    ComparisonProgress progress({.what = prefix});
    return compare_techniques(device, built_in_catalog(), one.scene, contestants, settings, progress.hooks());
}

Result<ComparedScenes> scenes_of(const CompareOptions& options) {
    Result<ComparedScenes> scenes = compared_scenes(options.choice);
    if (!scenes) return scenes;
    for (const SubjectCase& one : scenes->all) {
        Result<FileUse> files = files_of(options);
        if (files && scenes->is_set) files->outputs.push_back(report_path(options, *scenes, one));
        DERMIS_TRY(keep_scene_files(one.scene, files));
    }
    return scenes;
}

// Those that an earlier scene of the set did not have.
void print_new(const std::vector<std::string>& warnings, const std::string& prefix,
               std::set<std::string>& printed) {
    std::vector<std::string> fresh;
    std::ranges::copy_if(warnings, std::back_inserter(fresh),
                         [&](const std::string& text) { return printed.insert(text).second; });
    print_warnings(fresh, prefix);
}

Result<std::vector<Comparison>> compare_all(const CompareOptions& options, const ComparedScenes& scenes,
                                            const std::vector<Contestant>& contestants,
                                            ComparisonSettings settings) {
    DERMIS_TRY_ASSIGN(gpu::Device device, gpu::Device::create({.name_contains = options.choice.device}));
    std::vector<Comparison> comparisons;
    std::set<std::string> printed;
    for (const SubjectCase& one : scenes.all) {
        if (!comparisons.empty() && stop_requested()) break;
        const std::string prefix = scenes.is_set ? one.name + ": " : "";
        print_new(one.scene.warnings, prefix, printed);
        settings.exact = one.exact;
        Result<Comparison> comparison = compare(device, one, prefix, contestants, settings);
        if (!comparison) return Error{prefix + comparison.error().message};
        print_new(warnings_of(*comparison, settings), prefix, printed);
        DERMIS_TRY_ASSIGN(const std::string page, report_html(one.scene, *comparison, settings));
        DERMIS_TRY(write_text_file(report_path(options, scenes, one), page));
        comparisons.push_back(std::move(*comparison));
    }
    return comparisons;
}

Result<void> write_tables(const CompareOptions& options, const ComparedScenes& scenes,
                          const std::vector<Comparison>& comparisons) {
    std::vector<ScoreRow> rows;
    std::string regions;
    for (size_t i = 0; i < comparisons.size(); ++i) {
        std::ranges::move(score_rows(scenes.all[i].name, comparisons[i]), std::back_inserter(rows));
        const std::string text = regions_csv(scenes.all[i].name, comparisons[i]);
        regions += i == 0 ? text : text.substr(text.find('\n') + 1);  // one heading
    }
    const fs::path directory(options.output);
    const std::string scores = scores_csv(rows);
    const FileContent files[] = {{directory / "scores.csv", as_bytes(scores)},
                                 {directory / "regions.csv", as_bytes(regions)}};
    return write_files(files);
}

void print_results(const CompareOptions& options, const ComparedScenes& scenes,
                   const std::vector<Comparison>& comparisons) {
    if (options.json) {
        nlohmann::ordered_json all = nlohmann::ordered_json::array();
        for (size_t i = 0; i < comparisons.size(); ++i)
            all.push_back(to_json(options.output, scenes.all[i], comparisons[i]));
        std::printf("%s\n",
                    (scenes.is_set ? nlohmann::ordered_json{{"scenes", all}} : all[0]).dump(2).c_str());
        return;
    }
    const fs::path directory(options.output);
    if (scenes.is_set) {
        print_set_table(scenes.all, comparisons);
        std::printf("%s, regions.csv, a folder with report.html a scene\n",
                    (directory / "scores.csv").c_str());
        return;
    }
    print_table(comparisons[0]);
    std::printf("%s, scores.csv, regions.csv\n", (directory / "report.html").c_str());
    if (const std::string& credit = scenes.all[0].scene.credit; !credit.empty())
        std::printf("%s\n", credit.c_str());
}

Result<int> compare_scenes(const CompareOptions& options) {
    DERMIS_TRY_ASSIGN(const IndexRange range, clip_range(options.frame_range, options.choice.frames));
    if (options.choice.frames > 0)
        return run_clip_comparison(options.choice, range, options.output, options.json);
    DERMIS_TRY_ASSIGN(const ComparisonSettings settings, options.choice.settings());
    DERMIS_TRY_ASSIGN(const std::vector<Contestant> contestants, options.choice.contestants());
    DERMIS_TRY_ASSIGN(ComparedScenes scenes, scenes_of(options));
    const StopOnSignals stop_on_signals;
    DERMIS_TRY_ASSIGN(const std::vector<Comparison> comparisons,
                      compare_all(options, scenes, contestants, settings));
    scenes.all.resize(comparisons.size());  // those before Ctrl-C
    DERMIS_TRY(write_tables(options, scenes, comparisons));
    print_results(options, scenes, comparisons);
    return stop_requested() ? stopped_exit_code() : 0;
}

// Stopped before the first samples there is nothing to report.
Result<int> run(const CompareOptions& options) {
    Result<int> code = compare_scenes(options);
    if (code || !stop_requested()) return code;
    print_message(code.error().message);
    return stopped_exit_code();
}

// Ranges of a clip's frames as jobs that compare them; the merge is the whole comparison, whose references
// are then in the cache.
JobPlan split_frames(const CompareOptions& options, const Job& whole, int parts) {
    JobPlan plan{.work = {}, .merge = whole};
    parts = std::min(parts, options.choice.frames);
    for (int i = 0; i < parts; ++i) {
        const IndexRange range{options.choice.frames * i / parts, options.choice.frames * (i + 1) / parts};
        const std::string text = fmt::format("{}:{}", range.begin, range.end);
        Job job{.name = whole.name + " frames " + text,
                .hash = fmt::format("{}_{}_{}", whole.hash, range.begin, range.end),
                .words = whole.words,
                .results = clip_reports(options.output, range)};
        job.words.insert(job.words.end(), {"--frame-range", text});
        plan.work.push_back(std::move(job));
    }
    return plan;
}

// One job, as the techniques share the reference, or the frames of a clip.
Result<JobPlan> plan(const CompareOptions& options, const std::vector<std::string>& words, int parts) {
    if (!options.frame_range.empty())
        return Error{"--frame-range: dermis jobs chooses the ranges; leave it out"};
    DERMIS_TRY_ASSIGN(const ComparisonSettings settings, options.choice.settings());
    DERMIS_TRY(options.choice.contestants());
    DERMIS_TRY_ASSIGN(ComparedScenes scenes, scenes_of(options));
    if (options.choice.frames > 0) DERMIS_TRY(clip_times(options.choice, scenes.all[0].scene));
    std::vector<const Scene*> all;
    for (const SubjectCase& one : scenes.all) all.push_back(&one.scene);
    std::vector<std::string> content = words;
    for (const OwnPicture& picture : settings.pictures)
        content.push_back(Hasher().add(picture.with.bytes).add(picture.without.bytes).hex());
    const Result<std::string> hash = hash_of_job(all, content);
    if (!hash) return hash.error();
    const Job whole{.name = options.output,
                    .hash = *hash,
                    .words = words,
                    .results = {(fs::path(options.output) / "scores.csv").string(),
                                (fs::path(options.output) / "regions.csv").string()}};
    return options.choice.frames > 1 && parts > 1 ? split_frames(options, whole, parts)
                                                  : JobPlan{.work = {whole}};
}

}  // namespace

void add_compare_command(CommandLine& line) {
    auto options = std::make_shared<CompareOptions>();
    Command* command = line.add(
        "compare", "Compares techniques with the reference: captured shares, errors, a report with pictures",
        "dermis compare head_scan -t \"wrap,preintegrated[shadow=plain]\" -o out/compare\n"
        "  dermis compare unit -o out/unit   (small scenes with exact answers)\n"
        "  dermis compare bust --picture mine=with.exr,without.exr -o out/mine\n"
        "  dermis compare head.glb --clip talk --frames 8 -o out/talk");
    options->choice.scene.add_to(*command)->required();
    command->add_option("-t,--techniques", options->choice.techniques,
                        "technique[name=value,...],technique,... (default: every technique)");
    command
        ->add_output("-o,--output", options->output, "directory for report.html, scores.csv and regions.csv")
        ->required();
    command->add_option(
        "--picture", options->choice.pictures,
        "NAME=with.exr,without.exr: another renderer's picture of the scene, with and without "
        "scattering, gets a row; repeatable");
    command->add_option("--size", options->choice.size,
                        "WIDTHxHEIGHT in pixels (that of --picture, else 512x512; of the unit scenes 96x96)");
    command
        ->add_option("--integrator", options->choice.integrator,
                     "references: walk (transport), surface (the profile), both")
        ->capture_default_str();
    command
        ->add_option("--ambient", options->choice.ambient,
                     "environment in the reference: renderer (the renderer's approximation) or traced")
        ->capture_default_str();
    command->add_option("--samples-per-pixel", options->choice.samples_per_pixel, {1, 256},
                        "sample points in each pixel, the same in both pictures; a square number "
                        "(4 to 36, by the size)");
    command
        ->add_option("--noise", options->choice.noise, kReferenceNoiseRange,
                     "noise at which the reference stops, over the effect of scattering")
        ->capture_default_str();
    command
        ->add_option("--samples,--spp", options->choice.samples, kReferenceSamplesRange,
                     "maximum samples a pixel of the reference")
        ->capture_default_str();
    command->add_option("--frames", options->choice.frames, kClipFramesRange,
                        "compare this number of frames of the --clip, evenly over its length from --time on");
    command->add_option("--fps", options->choice.fps, kFpsRange,
                        "frames in a second of the --clip instead, from --time on");
    command->add_option("--frame-range", options->frame_range,
                        "BEGIN:END: compare only this range of the --frames, without what is of all frames; "
                        "references go to the cache");
    command->add_option(
        "--rest-bakes", options->choice.rest_bakes,
        "more rows, with bakes of the rest pose: normals, curvature, gain, occlusion, joined by "
        "+, or all; lists are separated by commas");
    command
        ->add_option("--timed-frames", options->choice.timed_frames, kTimedFramesRange,
                     "frames that are timed, after a first one that compiles the shaders")
        ->capture_default_str();
    command->add_option("--device", options->choice.device,
                        "use the Vulkan device with this text in its name");
    command->add_flag("--json", options->json, "print one JSON object");
    line.when_chosen(
        command, [options] { return files_of(*options); }, [options] { return run(*options); },
        [options, &line](int parts, const std::string&) { return plan(*options, line.words, parts); });
}

}  // namespace dermis::cli
