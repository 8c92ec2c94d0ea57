// All techniques against the ground truth, as docs/scoreboard.csv, .md and .svg. Run it by tools/scoreboard.
//
//     build/bench/scoreboard_bench DIRECTORY [SIZE] [SCENE...]
//
// A scene that is not there is passed over with a message; the rows it had are kept.

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "catalog/catalog.h"
#include "dermis/base/file.h"
#include "dermis/base/progress.h"
#include "dermis/judge/scoreboard.h"
#include "dermis/render/complete_scene.h"
#include "dermis/scene/load_scene.h"

namespace {

using namespace dermis;

constexpr const char* kText =
    "# Scoreboard\n\n"
    "Every technique against the ground truth of the same scene ([how](ground_truth.md)), sorted by error. "
    "Errors are of\n"
    "linear radiance over the skin; *terminator* is where |N·L| < 0.3, *penumbra* within 3 mm of a cast "
    "shadow's edge;\n"
    "FLIP, ΔE 2000 and SSIM are of the tone-mapped picture. Cost is the frame over lambert's in the same "
    "rounds of one\n"
    "run, %s, %d x %d; memory is what only this technique needs: tables and images of its own passes.\n\n"
    "`tools/scoreboard` makes this page, [scoreboard.csv](scoreboard.csv) and the plot again.\n\n"
    "![Error against cost](scoreboard.svg)\n\n";

int fail(const std::string& message) {
    std::fprintf(stderr, "scoreboard: %s\n", message.c_str());
    return 1;
}

Result<Comparison> compare(gpu::Device& device, const Scene& scene, int size) {
    ComparisonSettings settings = comparison_settings(size, size);
    Progress line("ground truth of " + scene.name, 0);
    return compare_techniques(
        device, built_in_catalog(), scene, scoreboard_contestants(built_in_catalog().techniques), settings,
        {.reference = [&](double done) { line.set(done); },
         .techniques = [&](double done, const std::string& name) { line.set(done, name); }});
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
    const int size = argc > 2 ? std::atoi(argv[2]) : 512;
    if (size < 16 || size > 4096) return fail("a size of 16 to 4096");
    std::vector<std::string> names(argv + std::min(argc, 3), argv + argc);
    if (names.empty()) names = {"spheres", "bust", "head_scan"};
    Result<std::vector<ScoreRow>> rows = kept_rows(directory / "scoreboard.csv");
    if (!rows) return fail(rows.error().message);
    Result<gpu::Device> device = gpu::Device::create({});
    if (!device) return fail(device.error().message);
    for (const std::string& name : names) {
        Result<Scene> scene = load_scene(name, {.subjects = built_in_catalog().subjects});
        Result<void> complete = scene ? complete_scene(*scene) : Result<void>(scene.error());
        if (!complete) {
            std::printf("%s is passed over, its rows stay: %s\n", name.c_str(),
                        complete.error().message.c_str());
            continue;
        }
        const Result<Comparison> comparison = compare(*device, *scene, size);
        if (!comparison) return fail(name + ": " + comparison.error().message);
        rows = merged(std::move(*rows), score_rows(name, *comparison));
        std::printf("%s: ground truth %.1f s%s, noise %.5f\n", name.c_str(), comparison->truth.time_ms / 1000,
                    comparison->truth.from_cache ? " (from the cache)" : "", comparison->reference_rmse);
        if (auto written = write(directory, *rows, device->info().name, size); !written)
            return fail(written.error().message);
    }
}
