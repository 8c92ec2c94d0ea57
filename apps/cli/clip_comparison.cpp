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
    ComparedFrames frames;
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
    ClipFrames& frames;
};

std::string frame_folder(int frame) {
    return fmt::format("frame_{:02}", frame);
}

Result<void> compare_frame(gpu::Device& device, const ClipWork& work, int frame, const ComparisonTurn& turn,
                           ClipResults& results) {
    const SubjectCase& one = work.frames.shown();
    const double time_s = work.frames.times_s()[size_t(frame)];
    results.print_new(one.scene.warnings);
    ComparisonProgress progress(turn);
    Result<Comparison> made =
        compare_techniques(device, work.frames.renderer(), built_in_catalog(), one.scene, work.contestants,
                           work.settings, progress.hooks());
    if (!made) return Error{turn.what + made.error().message};
    results.print_new(warnings_of(*made, work.settings));
    DERMIS_TRY_ASSIGN(const std::string page, report_html(one.scene, *made, work.settings));
    const std::string folder = frame_folder(frame);
    DERMIS_TRY(write_text_file(work.directory / folder / "report.html", page));
    results.links.push_back(folder + "/report.html");
    const std::string regions = regions_csv(one.name, *made);
    results.regions += results.regions.empty() ? regions : regions.substr(regions.find('\n') + 1);
    DERMIS_TRY(results.frames.add(one.name, time_s, *made));
    results.credit = one.scene.credit;
    nlohmann::ordered_json json = {{"time_s", time_s}};
    json.update(to_json((work.directory / folder).string(), one, *made));
    results.json.push_back(std::move(json));
    return {};
}

Result<void> write_clip_files(const ClipWork& work, const ClipResults& results) {
    std::vector<ScoreRow> rows;
    for (const ClipFrame& frame : results.frames.all)
        rows.insert(rows.end(), frame.rows.begin(), frame.rows.end());
    const std::string scores = scores_csv(rows), clip = clip_csv(results.frames.all),
                      page = clip_html(work.choice.scene.name + ", clip " + work.choice.scene.pose.clip,
                                       results.credit, results.frames.all, results.links);
    const FileContent files[] = {{work.directory / "report.html", as_bytes(page)},
                                 {work.directory / "clip.csv", as_bytes(clip)},
                                 {work.directory / "scores.csv", as_bytes(scores)},
                                 {work.directory / "regions.csv", as_bytes(results.regions)}};
    return write_files(files);
}

void print_clip(const ClipWork& work, const ClipResults& results, bool is_whole, bool json) {
    if (json) {
        const std::string& clip = work.choice.scene.pose.clip;
        std::printf("%s\n", clip_json(clip, results.frames.all, results.json).dump(2).c_str());
        return;
    }
    print_clip_table(results.frames.all);
    const std::string page =
        (work.directory / "report.html").string() + ", clip.csv, scores.csv, regions.csv, ";
    std::printf("%sa folder with report.html a frame\n", is_whole ? page.c_str() : "");
    if (!results.credit.empty()) std::printf("%s\n", results.credit.c_str());
}

}  // namespace

std::vector<std::string> clip_reports(const std::string& output, IndexRange range) {
    std::vector<std::string> reports;
    for (int frame = range.begin; frame < range.end; ++frame)
        reports.push_back((fs::path(output) / frame_folder(frame) / "report.html").string());
    return reports;
}

Result<int> run_clip_comparison(const CompareChoice& choice, IndexRange range, const std::string& output,
                                bool json) {
    DERMIS_TRY_ASSIGN(const ComparisonSettings settings, choice.settings());
    DERMIS_TRY_ASSIGN(const std::vector<Contestant> contestants, choice.contestants());
    const StopOnSignals stop_on_signals;
    DERMIS_TRY_ASSIGN(gpu::Device device, gpu::Device::create({.name_contains = choice.device}));
    DERMIS_TRY_ASSIGN(ClipFrames frames, ClipFrames::load(choice, device));
    const ClipWork work{choice, settings, contestants, output, frames};
    ClipResults results;
    const size_t count = size_t(range.end - range.begin), all = frames.times_s().size();
    for (int frame = range.begin; frame < range.end; ++frame) {
        DERMIS_TRY(frames.show(size_t(frame)));
        const Result<FileUse> kept =
            FileUse{.outputs = {work.directory / frame_folder(frame) / "report.html"}};
        DERMIS_TRY(keep_scene_files(frames.shown().scene, kept));
        const ComparisonTurn turn{fmt::format("frame {}/{}: ", frame + 1, all), size_t(frame - range.begin),
                                  count};
        const Result<void> compared = compare_frame(device, work, frame, turn, results);
        // Stopped before the frame's first samples: those before it count.
        if (!compared && !(stop_requested() && frame > range.begin)) return compared.error();
        if (stop_requested()) break;
    }
    const bool is_whole = count == all;
    if (is_whole) DERMIS_TRY(write_clip_files(work, results));
    print_clip(work, results, is_whole, json);
    return stop_requested() ? stopped_exit_code() : 0;
}

}  // namespace dermis::cli
