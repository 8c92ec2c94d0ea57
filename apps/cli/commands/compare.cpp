// dermis compare: techniques compared with the ground truth, as a page and a table.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "catalog/catalog.h"
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

namespace fs = std::filesystem;

constexpr int kMostGrid = 16;

struct Options {
    SceneChoice scene;
    std::string techniques, output, size = "512x512", device;
    std::string integrator = "surface", ambient = "renderer";
    ComparisonSettings defaults;
    double noise = defaults.noise;
    int samples = defaults.samples, samples_per_pixel = defaults.grid * defaults.grid,
        frames = defaults.frames;
    bool json = false;
};

Result<ComparisonSettings> settings_of(const Options& options) {
    const Result<Size> size = parse_size(options.size);
    if (!size) return size.error();
    ComparisonSettings settings = comparison_settings(size->width, size->height);
    settings.frames = options.frames;
    settings.noise = options.noise;
    settings.samples = options.samples;
    settings.grid = int(std::lround(std::sqrt(double(std::max(options.samples_per_pixel, 0)))));
    if (options.frames < 1 || options.frames > 1000)
        return Error{"--frames " + std::to_string(options.frames) + ": 1 to 1000"};
    if (settings.grid < 1 || settings.grid > kMostGrid ||
        settings.grid * settings.grid != options.samples_per_pixel)
        return Error{"--samples-per-pixel " + std::to_string(options.samples_per_pixel) +
                     ": a square number, 1, 4, 9, 16 ... " + std::to_string(kMostGrid * kMostGrid)};
    if (!(options.noise > 0 && options.noise <= 1))
        return Error{"--noise " + to_text(options.noise) + ": above 0, at most 1"};
    if (options.samples < 2 * options.samples_per_pixel || options.samples > 1 << 20)
        return Error{"--samples " + std::to_string(options.samples) +
                     ": at least twice --samples-per-pixel (" +
                     std::to_string(2 * options.samples_per_pixel) + "), at most " + std::to_string(1 << 20)};
    const std::vector<std::string> integrators = {"surface", "walk"}, ambients = {"renderer", "traced"};
    if (std::ranges::find(integrators, options.integrator) == integrators.end())
        return Error{unknown_name("integrator", options.integrator, integrators)};
    if (std::ranges::find(ambients, options.ambient) == ambients.end())
        return Error{unknown_name("ambient model", options.ambient, ambients)};
    if (options.integrator == "walk") settings.reference.integrator = Integrator::walk;
    if (options.ambient == "traced") settings.reference.lighting.ambient = AmbientModel::traced;
    return settings;
}

// Tried before minutes of work rather than after, by a file that is removed again with every directory that
// it needed: a comparison that cannot be made leaves nothing.
constexpr const char* kFiles[] = {"report.html", "scores.csv", "regions.csv"};

Result<void> try_directory(const fs::path& directory) {
    std::error_code ec;
    if (fs::exists(directory, ec) && !fs::is_directory(directory, ec))
        return Error{"-o " + directory.string() + ": is a file; name a directory for the report"};
    for (const char* name : kFiles)
        if (const Result<void> tried = try_output(directory / name); !tried)
            return Error{"-o " + directory.string() + ": " + tried.error().message};
    return {};
}

Result<Scene> scene_of(const Options& options) {
    Result<Scene> scene = options.scene.load();
    if (!scene) return scene;
    if (Result<void> completed = complete_scene(*scene); !completed) return completed.error();
    return scene;
}

Result<Comparison> compare(const Options& options, const Scene& scene,
                           const std::vector<Contestant>& contestants, const ComparisonSettings& settings) {
    Result<gpu::Device> device = gpu::Device::create({.name_contains = options.device});
    if (!device) return device.error();
    Progress line("ground truth", 0);
    std::optional<Progress> techniques;
    return compare_techniques(*device, built_in_catalog(), scene, contestants, settings,
                              {.reference = [&](double done) { line.set(done); },
                               .techniques =
                                   [&](double done, const std::string& name) {
                                       if (!techniques) techniques.emplace("techniques", 0);
                                       techniques->set(done, name);
                                   }});
}

std::string share_text(const CapturedShare& share) {
    char text[16] = "noise";
    if (share.known()) std::snprintf(text, sizeof text, "%.3f", share.share);
    return text;
}

void print_table(const Comparison& comparison) {
    std::printf("%-48s %8s %6s %7s %7s %7s %9s %7s %7s %9s\n", "technique", "captured", "+-", "R", "G", "B",
                "rmse", "flip", "dE2000", "ms");
    for (const Compared& row : comparison.rows) {
        const Captured& c = row.captured;
        std::printf("%-48s %8s %6.3f %7s %7s %7s %9.5f %7.4f %7.3f %9.2f\n", row.contestant.name().c_str(),
                    share_text(c.all).c_str(), c.all.error, share_text(c.channels[0]).c_str(),
                    share_text(c.channels[1]).c_str(), share_text(c.channels[2]).c_str(), row.scores.rmse,
                    row.scores.flip, row.scores.delta_e_2000, row.cost.time_ms);
    }
    const CapturedShare& all = comparison.rows.front().captured.all;
    std::printf("effect of scattering: rms %.5f (R %.5f, G %.5f, B %.5f)\n", all.effect_rms,
                comparison.rows.front().captured.channels[0].effect_rms,
                comparison.rows.front().captured.channels[1].effect_rms,
                comparison.rows.front().captured.channels[2].effect_rms);
    std::printf("the ground truth's noise: %.5f of the effect, %.5f of the picture; %d samples a pixel, %s\n",
                all.truth_noise, comparison.reference_rmse, comparison.truth.samples,
                comparison.truth.from_cache ? "from the cache" : "made now");
}

// What limits the numbers.
std::vector<std::string> warnings_of(const Comparison& comparison, const ComparisonSettings& settings) {
    std::vector<std::string> warnings = comparison.truth.warnings;
    const EffectNoise& noise = comparison.truth.noise;
    if (!comparison.truth.reached)
        warnings.push_back("the ground truth stopped at its limit of " + std::to_string(settings.samples) +
                           " samples a pixel with a noise of " +
                           to_text(float(std::round(1000 * noise.noise_rms / noise.effect_rms) / 1000)) +
                           " of the effect, not " + to_text(settings.noise) + "; raise --samples");
    return warnings;
}

nlohmann::ordered_json to_json(const Options& options, const Scene& scene, const Comparison& comparison) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const ScoreRow& row : score_rows(options.scene.name, comparison)) {
        nlohmann::ordered_json entry = {{"technique", row.technique}, {"settings", row.settings}};
        for (const ScoreColumn& column : score_columns()) {
            const std::optional<double> value = column.get(row);
            entry[std::string(column.name)] =
                value && std::isfinite(*value) ? nlohmann::ordered_json(*value) : nullptr;
        }
        rows.push_back(std::move(entry));
    }
    return {{"scene", scene.name},
            {"output", options.output},
            {"truth_samples", comparison.truth.samples},
            {"truth_reached", comparison.truth.reached},
            {"reference_from_cache", comparison.truth.from_cache},
            {"reference_time_ms", comparison.truth.time_ms},
            {"rows", rows},
            {"credit", scene.credit}};
}

Result<int> run(const Options& options) {
    const Result<ComparisonSettings> settings = settings_of(options);
    if (!settings) return settings.error();
    const std::span<const Technique> techniques = built_in_catalog().techniques;
    const Result<std::vector<Contestant>> contestants =
        options.techniques.empty() ? default_contestants(techniques)
                                   : parse_technique_list(techniques, options.techniques);
    if (!contestants) return contestants.error();
    if (Result<void> good = try_directory(options.output); !good) return good.error();
    const Result<Scene> scene = scene_of(options);
    if (!scene) return scene.error();
    for (const std::string& warning : scene->warnings) print_warning(warning);
    const Result<Comparison> comparison = compare(options, *scene, *contestants, *settings);
    if (!comparison) return comparison.error();
    for (const std::string& warning : warnings_of(*comparison, *settings)) print_warning(warning);
    const Result<std::string> page = report_html(*scene, *comparison, *settings);
    if (!page) return page.error();
    const fs::path directory(options.output);
    const std::string scores = scores_csv(score_rows(options.scene.name, *comparison)),
                      regions = regions_csv(options.scene.name, *comparison);
    const FileContent files[] = {{directory / kFiles[0], as_bytes(*page)},
                                 {directory / kFiles[1], as_bytes(scores)},
                                 {directory / kFiles[2], as_bytes(regions)}};
    if (Result<void> written = write_files(files); !written) return written.error();
    if (options.json) {
        std::printf("%s\n", to_json(options, *scene, *comparison).dump(2).c_str());
        return 0;
    }
    print_table(*comparison);
    std::printf("%s, scores.csv, regions.csv\n", (directory / "report.html").c_str());
    if (!scene->credit.empty()) std::printf("%s\n", scene->credit.c_str());
    return 0;
}

}  // namespace

void add_compare_command(CommandLine& line) {
    auto options = std::make_shared<Options>();
    Command* command =
        line.add("compare",
                 "Compares techniques with the ground truth: captured shares, errors, a report with pictures",
                 "dermis compare head_scan --techniques "
                 "\"lambert,wrap,preintegrated[diffuse=curve_2015,shadow=plain]\" "
                 "-o out/compare");
    options->scene.add_to(*command)->required();
    command->add_option("-t,--techniques", options->techniques,
                        "technique[name=value,...],technique,... (default: every technique)");
    command
        ->add_option("-o,--output", options->output, "directory for report.html, scores.csv and regions.csv")
        ->required();
    command->add_option("--size", options->size, "WIDTHxHEIGHT in pixels")->capture_default_str();
    command
        ->add_option("--integrator", options->integrator, "integrator of the ground truth: surface or walk")
        ->capture_default_str();
    command
        ->add_option("--ambient", options->ambient,
                     "environment in the ground truth: renderer (the renderer's approximation) or traced")
        ->capture_default_str();
    command
        ->add_option("--samples-per-pixel", options->samples_per_pixel,
                     "sample points in each pixel, the same in both pictures; a square number")
        ->capture_default_str();
    command
        ->add_option("--noise", options->noise,
                     "noise at which the ground truth stops, over the effect of scattering")
        ->capture_default_str();
    command->add_option("--samples,--spp", options->samples, "maximum samples a pixel of the ground truth")
        ->capture_default_str();
    command
        ->add_option("--frames", options->frames,
                     "frames that are timed, after a first one that compiles the shaders")
        ->capture_default_str();
    command->add_option("--device", options->device, "use the Vulkan device with this text in its name");
    command->add_flag("--json", options->json, "print one JSON object");
    line.when_chosen(command, [options] { return run(*options); });
}

}  // namespace dermis::cli
