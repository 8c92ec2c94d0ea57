// All techniques against the ground truth, as docs/scoreboard.csv, .md and .svg. Run it by tools/scoreboard.
//
//     build/bench/scoreboard_bench DIRECTORY [SIZE] [SCENE...]
//
// A missing scene is skipped with a message and its old rows are kept. The rows of a scene are cached under a
// hash of this program, the scene and the settings: a run that was stopped continues with the scene it was
// at, and with its ground truth.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "catalog/catalog.h"
#include "dermis/base/cache.h"
#include "dermis/base/file.h"
#include "dermis/base/hash.h"
#include "dermis/base/progress.h"
#include "dermis/judge/reference_cache.h"
#include "dermis/judge/scoreboard.h"
#include "dermis/render/complete_scene.h"
#include "dermis/scene/load_scene.h"

namespace {

using namespace dermis;

constexpr const char* kScenes[] = {"spheres", "unit", "bust", "head_scan", "face", "backlit"};
// Of each unit scene, whose subject fills the picture.
constexpr int kCaseSize = 96;

constexpr const char* kText =
    "# Scoreboard\n\n"
    "How much of what scattering does to a picture each technique does too ([how](ground_truth.md)): "
    "**captured** is 1 for\n"
    "the ground truth, 0 for `lambert`, and below 0 where a technique does more harm than good; ± is half of "
    "its 95 %%\n"
    "interval, R, G and B are the channels. Red is most of the effect, and green and blue scatter a few "
    "tenths of a\n"
    "millimetre: less than a pixel here. \"noise\": the ground truth is not fine enough to tell. RMSE "
    "(linear radiance over the\n"
    "skin), FLIP and ΔE 2000 (tone-mapped picture) also hold what the two renderers do differently for other "
    "reasons.\n"
    "Cost is the frame over lambert's in the same rounds of one run, %s, %d x %d (unit scenes 96 x 96);\n"
    "memory is what "
    "only this technique needs: tables and images of its own passes.\n\n"
    "`tools/scoreboard` makes this page, [scoreboard.csv](scoreboard.csv) and the plot again.\n\n"
    "![Captured share over cost](scoreboard.svg)\n\n";

int fail(const std::string& message) {
    std::fprintf(stderr, "scoreboard: %s\n", message.c_str());
    return 1;
}

Result<std::vector<ScoreRow>> compare(gpu::Device& device, const std::string& name, const Scene& scene,
                                      const ComparisonSettings& settings) {
    Progress line("ground truth of " + name, 0);
    std::optional<Progress> techniques;
    const Result<Comparison> comparison = compare_techniques(
        device, built_in_catalog(), scene, scoreboard_contestants(built_in_catalog().techniques), settings,
        {.reference = [&](double done) { line.set(done); },
         .techniques =
             [&](double done, const std::string& technique) {
                 if (!techniques) techniques.emplace(name, 0);
                 techniques->set(done, name + ": " + technique);
             }});
    if (!comparison) return comparison.error();
    const EffectTruth& truth = comparison->truth;
    std::printf("%s: ground truth of %d samples a pixel in %.0f s%s, noise %.2f of the effect%s\n",
                name.c_str(), truth.samples, truth.time_ms / 1000,
                truth.from_cache ? " (from the cache)" : "", truth.noise.noise_rms / truth.noise.effect_rms,
                truth.reached ? "" : ": not as fine as asked for");
    return score_rows(name, *comparison);
}

// Everything that a scene's rows depend on: this program with its shaders and techniques, the scene, the
// settings.
Result<std::string> rows_hash(const Scene& scene, const ComparisonSettings& settings) {
    const Result<std::vector<std::byte>> program = read_file("/proc/self/exe");
    if (!program) return program.error();
    ReferenceSettings reference = settings.reference;
    reference.width = settings.width;
    reference.height = settings.height;
    const Result<std::string> truth = reference_hash(scene, reference);
    if (!truth) return truth.error();
    return Hasher()
        .add(std::span(*program))
        .add(std::string_view(*truth))
        .add(settings.grid)
        .add(settings.noise)
        .add(settings.samples)
        .add(settings.probes)
        .hex();
}

// A scene to do: by its name, or one of a set of test scenes that is already made.
struct Job {
    std::string name;
    std::optional<SubjectCase> made;
};

Result<std::vector<Job>> jobs_of(const std::vector<std::string>& names) {
    const std::span<const Subject> subjects = built_in_catalog().subjects;
    std::vector<Job> jobs;
    for (const std::string& name : names) {
        const auto set = std::ranges::find(subjects, name, &Subject::name);
        if (set == subjects.end() || set->cases.empty()) {
            jobs.push_back({.name = name});
            continue;
        }
        Result<std::vector<SubjectCase>> cases = make_cases(*set);
        if (!cases) return cases.error();
        for (SubjectCase& one : *cases) jobs.push_back({.name = one.name, .made = std::move(one)});
    }
    return jobs;
}

Result<SubjectCase> scene_of(Job& job) {
    if (!job.made) {
        Result<Scene> scene = load_scene(job.name, {.subjects = built_in_catalog().subjects});
        if (!scene) return scene.error();
        job.made = {.name = job.name, .scene = std::move(*scene)};
    }
    if (Result<void> complete = complete_scene(job.made->scene); !complete) return complete.error();
    return std::move(*job.made);
}

// From the cache, or computed and stored there.
Result<std::vector<ScoreRow>> rows_of(gpu::Device& device, const std::string& name, const Scene& scene,
                                      const ComparisonSettings& settings) {
    const Result<std::string> hash = rows_hash(scene, settings);
    if (!hash) return hash.error();
    if (const auto bytes = cache_load("scoreboard", *hash)) {
        std::printf("%s: was made before\n", name.c_str());
        return parse_scores({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
    }
    Result<std::vector<ScoreRow>> rows = compare(device, name, scene, settings);
    if (!rows) return rows.error();
    const std::string text = scores_csv(*rows);
    const auto bytes = std::as_bytes(std::span(text));
    cache_store("scoreboard", *hash, {bytes.begin(), bytes.end()});
    return rows;
}

Result<std::vector<ScoreRow>> kept_rows(const std::filesystem::path& csv) {
    std::error_code ec;
    if (!std::filesystem::exists(csv, ec)) return std::vector<ScoreRow>();
    const Result<std::string> text = read_text_file(csv);
    if (!text) return text.error();
    return parse_scores(*text);
}

Result<void> write(const std::filesystem::path& directory, const std::vector<ScoreRow>& rows,
                   const std::string& device, int size) {
    char heading[2048];
    std::snprintf(heading, sizeof heading, kText, device.c_str(), size, size);
    if (auto done = write_text_file(directory / "scoreboard.csv", scores_csv(rows)); !done) return done;
    if (auto done = write_plot(directory / "scoreboard.svg", scoreboard_plot(rows)); !done) return done;
    return write_text_file(directory / "scoreboard.md", heading + scoreboard_markdown(rows));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) return fail("name the directory for scoreboard.csv, .md and .svg");
    const std::filesystem::path directory = argv[1];
    const int size = argc > 2 ? std::atoi(argv[2]) : 256;
    if (size < 16 || size > 4096) return fail("a size of 16 to 4096");
    std::vector<std::string> names(argv + std::min(argc, 3), argv + argc);
    if (names.empty()) names.assign(std::begin(kScenes), std::end(kScenes));
    Result<std::vector<ScoreRow>> rows = kept_rows(directory / "scoreboard.csv");
    if (!rows) return fail(rows.error().message);
    Result<gpu::Device> device = gpu::Device::create({});
    if (!device) return fail(device.error().message);
    ComparisonSettings settings = comparison_settings(size, size);
    settings.frames = 2;
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    Result<std::vector<Job>> jobs = jobs_of(names);
    if (!jobs) return fail(jobs.error().message);
    const auto start = std::chrono::steady_clock::now();
    for (size_t i = 0; i < jobs->size(); ++i) {
        Job& job = (*jobs)[i];
        ComparisonSettings own = settings;
        if (job.made) own.width = own.height = std::min(size, kCaseSize);
        const Result<SubjectCase> one = scene_of(job);
        if (!one) {
            std::printf("%s is passed over, its rows stay: %s\n", job.name.c_str(),
                        one.error().message.c_str());
            continue;
        }
        own.exact = one->exact;
        const Result<std::vector<ScoreRow>> made = rows_of(*device, one->name, one->scene, own);
        if (!made) return fail(one->name + ": " + made.error().message);
        rows = merged(std::move(*rows), *made);
        if (auto written = write(directory, *rows, device->info().name, size); !written)
            return fail(written.error().message);
        const double done_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        const size_t left = jobs->size() - i - 1;
        if (left > 0)
            std::printf("%zu of %zu scenes are left, about %.0f min if they take as long\n", left,
                        jobs->size(), done_s / double(i + 1) * double(left) / 60);
    }
}
