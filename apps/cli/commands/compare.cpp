// dermis compare: techniques held against the ground truth, as a page and a table.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "dermis/base/file.h"
#include "dermis/base/progress.h"
#include "dermis/base/text.h"
#include "dermis/judge/comparison.h"
#include "dermis/judge/report.h"
#include "dermis/render/complete_scene.h"
#include "render_options.h"

namespace dermis::cli {
namespace {

struct Options {
    std::string scene, techniques, output, size = "512x512", camera, light, device;
    std::string integrator = "surface", ambient = "renderer";
    double noise = 0.01;
    int samples = 256, frames = 5;
    bool json = false;
};

Result<ComparisonSettings> settings_of(const Options& options) {
    const Result<std::pair<int, int>> size = parse_size(options.size);
    if (!size) return size.error();
    ComparisonSettings settings = comparison_settings(size->first, size->second);
    settings.frames = options.frames;
    settings.reference.noise = options.noise;
    settings.reference.samples = options.samples;
    if (options.frames < 1 || options.frames > 1000)
        return Error{"--frames " + std::to_string(options.frames) + ": 1 to 1000"};
    const std::vector<std::string> integrators = {"surface", "walk"}, ambients = {"renderer", "traced"};
    if (std::ranges::find(integrators, options.integrator) == integrators.end())
        return Error{unknown_name("integrator", options.integrator, integrators)};
    if (std::ranges::find(ambients, options.ambient) == ambients.end())
        return Error{unknown_name("ambient model", options.ambient, ambients)};
    if (options.integrator == "walk") settings.reference.integrator = Integrator::walk;
    if (options.ambient == "traced") settings.reference.lighting.ambient = AmbientModel::traced;
    return settings;
}

// Found before minutes of work rather than after.
Result<void> check_directory(const std::string& directory) {
    std::error_code ec;
    const std::filesystem::path path(directory);
    if (std::filesystem::exists(path, ec) && !std::filesystem::is_directory(path, ec))
        return Error{"-o " + directory + ": is a file; name a directory for report.html and scores.csv"};
    return {};
}

Result<Scene> scene_of(const Options& options) {
    Result<Scene> scene = load_scene(options.scene);
    if (!scene) return scene;
    if (Result<void> applied = apply_views(*scene, options.camera, options.light); !applied)
        return applied.error();
    if (Result<void> completed = complete_scene(*scene); !completed) return completed.error();
    return scene;
}

Result<Comparison> compare(const Options& options, const Scene& scene,
                           const std::vector<Contestant>& contestants, const ComparisonSettings& settings) {
    Result<gpu::Device> device = gpu::Device::create({.name_contains = options.device});
    if (!device) return device.error();
    constexpr double kSteps = 1000;
    Progress line("ground truth", size_t(kSteps));
    size_t shown = 0;
    return compare_techniques(*device, scene, contestants, settings, {.reference = [&](double done) {
        const auto now = size_t(done * kSteps);
        if (now > shown) line.advance(now - shown);
        shown = std::max(shown, now);
    }});
}

void print_table(const Comparison& comparison) {
    std::printf("%-48s %9s %9s %9s %7s %7s %9s\n", "technique", "rmse", "terminat.", "penumbra", "flip",
                "dE2000", "ms");
    for (const Compared& row : comparison.rows) {
        const Scores& s = row.scores;
        std::printf("%-48s %9.5f %9.5f %9.5f %7.4f %7.3f %9.2f\n", row.contestant.name().c_str(), s.rmse,
                    s.terminator_rmse.value_or(0), s.penumbra_rmse.value_or(0), s.flip, s.delta_e_2000,
                    row.time_ms);
    }
    std::printf("the ground truth's own noise: rmse %.5f, %s\n", comparison.reference_rmse,
                comparison.reference.from_cache ? "from the cache" : "made now");
}

nlohmann::ordered_json to_json(const Options& options, const Scene& scene, const Comparison& comparison) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const Compared& row : comparison.rows)
        rows.push_back({{"technique", row.contestant.technique->id},
                        {"settings", row.contestant.settings},
                        {"rmse", row.scores.rmse},
                        {"flip", row.scores.flip},
                        {"time_ms", row.time_ms},
                        {"time_ratio", row.time_ratio},
                        {"bytes", row.bytes()}});
    return {{"scene", scene.name},
            {"output", options.output},
            {"reference_rmse", comparison.reference_rmse},
            {"reference_from_cache", comparison.reference.from_cache},
            {"reference_time_ms", comparison.reference.picture.time_ms},
            {"rows", rows},
            {"credit", scene.credit}};
}

Result<int> run(const Options& options) {
    const Result<ComparisonSettings> settings = settings_of(options);
    if (!settings) return settings.error();
    const Result<std::vector<Contestant>> contestants =
        options.techniques.empty() ? default_contestants() : parse_technique_list(options.techniques);
    if (!contestants) return contestants.error();
    if (Result<void> good = check_directory(options.output); !good) return good.error();
    const Result<Scene> scene = scene_of(options);
    if (!scene) return scene.error();
    for (const std::string& warning : scene->warnings)
        std::fprintf(stderr, "dermis: warning: %s\n", warning.c_str());
    const Result<Comparison> comparison = compare(options, *scene, *contestants, *settings);
    if (!comparison) return comparison.error();
    const Result<std::string> page = report_html(*scene, *comparison, *settings);
    if (!page) return page.error();
    const std::filesystem::path directory(options.output);
    if (Result<void> written = write_text_file(directory / "report.html", *page); !written)
        return written.error();
    if (Result<void> written =
            write_text_file(directory / "scores.csv", scores_csv(score_rows(options.scene, *comparison)));
        !written)
        return written.error();
    if (options.json) {
        std::printf("%s\n", to_json(options, *scene, *comparison).dump(2).c_str());
        return 0;
    }
    print_table(*comparison);
    std::printf("%s, %s\n", (directory / "report.html").c_str(), (directory / "scores.csv").c_str());
    if (!scene->credit.empty()) std::printf("%s\n", scene->credit.c_str());
    return 0;
}

}  // namespace

void add_compare_command(CommandLine& line) {
    auto options = std::make_shared<Options>();
    Command* command = line.add(
        "compare", "techniques held against the ground truth: a page with a wipe slider, a table of errors",
        "dermis compare head_scan --techniques "
        "\"lambert,wrap,preintegrated[diffuse=curve_2015,shadow=plain]\" "
        "-o out/compare");
    command->add_option("scene", options->scene, "scene file, mesh, scene name or builtin:NAME")->required();
    command->add_option("-t,--techniques", options->techniques,
                        "technique[name=value,...],technique,... (default: every technique)");
    command->add_option("-o,--output", options->output, "directory for report.html and scores.csv")
        ->required();
    command->add_option("--size", options->size, "WIDTHxHEIGHT in pixels")->capture_default_str();
    command->add_option("--camera", options->camera, "\"yaw=30 pitch=5 distance_mm=600 fov_deg=30\"");
    command->add_option("--light", options->light, "\"yaw=-60 pitch=20 intensity=3\" for the key light");
    command->add_option("--integrator", options->integrator, "of the ground truth: surface or walk")
        ->capture_default_str();
    command
        ->add_option("--ambient", options->ambient,
                     "of the ground truth: renderer (the same approximation on both sides) or traced")
        ->capture_default_str();
    command->add_option("--noise", options->noise, "relative error at which the ground truth stops")
        ->capture_default_str();
    command->add_option("--samples,--spp", options->samples, "samples a pixel of the ground truth, at most")
        ->capture_default_str();
    command->add_option("--frames", options->frames, "how many are timed, after one that compiles")
        ->capture_default_str();
    command->add_option("--device", options->device, "part of a Vulkan device's name");
    command->add_flag("--json", options->json, "print one JSON object");
    line.when_chosen(command, [options] { return run(*options); });
}

}  // namespace dermis::cli
