#include "clip_comparison.h"

#include <fmt/core.h>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "catalog/catalog.h"
#include "compare_text.h"
#include "comparison_progress.h"
#include "dermis/base/file.h"
#include "dermis/judge/clip_motion.h"
#include "dermis/judge/report.h"
#include "stop_on_signals.h"

namespace dermis::cli {
namespace {

namespace fs = std::filesystem;

// What is kept of all frames.
struct ClipResults {
    std::vector<ClipFrame> frames;
    std::optional<ClipEffects> before;  // effects of the frame that was compared last
    std::vector<std::string> links;
    std::string regions, credit;
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    std::set<std::string> printed;

    void print_new(const std::vector<std::string>& warnings) {
        std::vector<std::string> fresh;
        std::ranges::copy_if(warnings, std::back_inserter(fresh),
                             [&](const std::string& text) { return printed.insert(text).second; });
        print_warnings(fresh);
    }
};

struct ClipWork {
    const CompareChoice& choice;
    const ComparisonSettings& settings;
    const std::vector<Contestant>& contestants;
    fs::path directory;
};

std::string frame_folder(size_t frame) {
    return fmt::format("frame_{:02}", frame);
}

Result<void> compare_frame(gpu::Device& device, const ClipWork& work, const SubjectCase& one, double time_s,
                           const ComparisonTurn& turn, ClipResults& results) {
    results.print_new(one.scene.warnings);
    ComparisonProgress progress(turn);
    Result<Comparison> made = compare_techniques(device, built_in_catalog(), one.scene, work.contestants,
                                                 work.settings, progress.hooks());
    if (!made) return Error{turn.what + made.error().message};
    results.print_new(warnings_of(*made, work.settings));
    DERMIS_TRY_ASSIGN(const std::string page, report_html(one.scene, *made, work.settings));
    const std::string folder = frame_folder(turn.index);
    DERMIS_TRY(write_text_file(work.directory / folder / "report.html", page));
    results.links.push_back(folder + "/report.html");
    const std::string regions = regions_csv(one.name, *made);
    results.regions += results.regions.empty() ? regions : regions.substr(regions.find('\n') + 1);
    results.frames.push_back({.time_s = time_s, .rows = score_rows(one.name, *made)});
    ClipEffects effects = clip_effects(*made);
    if (results.before) DERMIS_TRY(set_motion_shares(*results.before, effects, results.frames.back().rows));
    results.before = std::move(effects);
    results.credit = one.scene.credit;
    nlohmann::ordered_json frame = {{"time_s", time_s}};
    frame.update(to_json((work.directory / folder).string(), one, *made));
    results.json.push_back(std::move(frame));
    return {};
}

Result<void> write_clip_files(const ClipWork& work, const ClipResults& results) {
    std::vector<ScoreRow> rows;
    for (const ClipFrame& frame : results.frames)
        rows.insert(rows.end(), frame.rows.begin(), frame.rows.end());
    const std::string scores = scores_csv(rows), clip = clip_csv(results.frames),
                      page = clip_html(work.choice.scene.name + ", clip " + work.choice.scene.pose.clip,
                                       results.credit, results.frames, results.links);
    const FileContent files[] = {{work.directory / "report.html", as_bytes(page)},
                                 {work.directory / "clip.csv", as_bytes(clip)},
                                 {work.directory / "scores.csv", as_bytes(scores)},
                                 {work.directory / "regions.csv", as_bytes(results.regions)}};
    return write_files(files);
}

}  // namespace

Result<int> run_clip_comparison(const CompareChoice& choice, const std::string& output, bool json) {
    DERMIS_TRY_ASSIGN(const ComparisonSettings settings, choice.settings());
    DERMIS_TRY_ASSIGN(const std::vector<Contestant> contestants, choice.contestants());
    DERMIS_TRY_ASSIGN(const std::vector<double> times, clip_times(choice));
    const ClipWork work{choice, settings, contestants, output};
    const StopOnSignals stop_on_signals;
    DERMIS_TRY_ASSIGN(gpu::Device device, gpu::Device::create({.name_contains = choice.device}));
    ClipResults results;
    std::optional<Scene> first;
    for (size_t i = 0; i < times.size() && !stop_requested(); ++i) {
        DERMIS_TRY_ASSIGN(const SubjectCase one, clip_frame(choice, times[i], first ? &*first : nullptr));
        const Result<FileUse> kept = FileUse{.outputs = {work.directory / frame_folder(i) / "report.html"}};
        DERMIS_TRY(keep_scene_files(one.scene, kept));
        const ComparisonTurn turn{fmt::format("frame {}/{}: ", i + 1, times.size()), i, times.size()};
        const Result<void> compared = compare_frame(device, work, one, times[i], turn, results);
        // Stopped before the frame's first samples: those before it count.
        if (!compared && !(stop_requested() && i > 0)) return compared.error();
        if (!first) first = without_objects(one.scene);
    }
    DERMIS_TRY(write_clip_files(work, results));
    if (json) {
        std::printf("%s\n", clip_json(choice.scene.pose.clip, results.frames, results.json).dump(2).c_str());
    } else {
        print_clip_table(results.frames);
        std::printf("%s, clip.csv, scores.csv, regions.csv, a folder with report.html a frame\n",
                    (work.directory / "report.html").c_str());
        if (!results.credit.empty()) std::printf("%s\n", results.credit.c_str());
    }
    return stop_requested() ? stopped_exit_code() : 0;
}

}  // namespace dermis::cli
