// All techniques against the reference, as docs/scoreboard.csv, .md and .svg. Run it by tools/scoreboard.
//
// Two references judge: walk, which sorts the rows, and surface.
//
//     build/bench/scoreboard_bench DIRECTORY [SIZE] [SCENE...] [--techniques LIST] [--models]
//
// --techniques takes a list as `dermis compare` does: only their rows are made again, lambert's too, which is
// the unit of costs. --models keeps all rows and computes their modelled costs again, in minutes; SIZE is
// then the one that the board was made with. A missing scene is skipped with a message and its old rows are
// kept. The rows of a scene are cached under a hash of this program, the scene and the settings: a run that
// was stopped continues with the scene it was at, and with its reference.

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
#include "dermis/base/text.h"
#include "dermis/gpu/statistics.h"
#include "dermis/judge/clip_motion.h"
#include "dermis/judge/reference_cache.h"
#include "dermis/judge/scoreboard.h"
#include "dermis/optics/presets.h"
#include "dermis/render/complete_scene.h"
#include "dermis/render/move_scene.h"
#include "dermis/report/ratios.h"
#include "dermis/scene/load_scene.h"
#include "dermis/scene/scene_views.h"

namespace {

using namespace dermis;

// SCENE[@VIEW][/PROFILE]. The profile is one that the scene's skin takes: light, medium and dark skin.
constexpr const char* kScenes[] = {"spheres",
                                   "unit",
                                   "bust",
                                   "bust/openpbr_skin_1",
                                   "bust/openpbr_skin_3",
                                   "bust/openpbr_skin_6",
                                   "head_scan",
                                   "head_scan/openpbr_skin_1",
                                   "head_scan/openpbr_skin_3",
                                   "head_scan/openpbr_skin_6",
                                   "face",
                                   "face/openpbr_skin_1",
                                   "face/openpbr_skin_3",
                                   "face/openpbr_skin_6",
                                   "head_scan@nose/openpbr_skin_1",
                                   "head_scan@nose/openpbr_skin_3",
                                   "head_scan@nose/openpbr_skin_6",
                                   "head_scan@lips/openpbr_skin_1",
                                   "head_scan@lips/openpbr_skin_3",
                                   "head_scan@lips/openpbr_skin_6",
                                   "head_scan@ear/openpbr_skin_1",
                                   "head_scan@ear/openpbr_skin_3",
                                   "head_scan@ear/openpbr_skin_6",
                                   "backlit",
                                   "bust greet"};
// Of a scene "HEAD CLIP": its frames; of the bust's clip those in which the jaw opens.
constexpr double kClipStart_s = 2.9, kClipFramesPerS = 24;
constexpr int kClipFrames = 3;
// What follows an @ in a scene's name: a view of the head scan, 47 mm wide.
struct NearView {
    std::string_view name;
    Vec3 target_mm;
    float yaw_deg;
};
constexpr NearView kNearViews[] = {
    {"nose", {0, 44, 115}, 14}, {"lips", {-1, 14, 112}, 14}, {"ear", {-75, 54, 9}, -75}};
constexpr float kNearPitchDeg = 2, kNearDistanceMm = 420, kNearFovDeg = 6.4f;
// Of each unit scene, whose subject fills the picture.
constexpr int kCaseSize = 96;
// Of a clip. The change between two frames is less than the effect, so its references are finer.
constexpr int kClipSize = 96;
constexpr double kClipNoise = .2;
// Of noise_of_size(), which leaves shares above .7 without a known digit.
constexpr double kNoiseShare = .5;
// A larger picture reaches it with fewer walks a sample than a comparison takes.
constexpr int kCoarseSide = 128, kFewWalks = 6;
// What costs are modelled for: the frame of docs/performance.md.
constexpr const char* kModelChip = "navi21";
constexpr int kModelWidth = 1920, kModelHeight = 1080;

constexpr const char* kText =
    "# Scoreboard\n\n"
    "**of `walk`**, **of `surface`**: how much of the effect of scattering by that reference a technique has "
    "([definition](reference.md#comparing)): 1 for the\n"
    "reference, 0 for `lambert`, below 0 if worse than `lambert`; ± is half of the 95 %% interval. R, G, "
    "B: the\n"
    "channels of the first. `bust/openpbr_skin_1` is the bust with that profile, `head_scan@nose` a view 47 "
    "mm wide. noise: "
    "the reference is not\n"
    "fine enough, or has not judged these settings. **Measured**: a frame over lambert's in one run, %s,\n"
    "%d x %d (unit scenes and clip 96 x 96). **Modelled**: the same for a %s at %d x %d, a model\n"
    "([assumptions](performance.md)); empty where Mesa's RADV was not installed. Memory: tables and images "
    "of the technique\n"
    "alone. scoreboard.csv also has RMSE, FLIP and ΔE 2000. A clip has the "
    "means of its frames; **its motion**: the captured\n"
    "share of the change of the effect from frame to frame ([the same of another "
    "face](figures.md#motion)).\n\n"
    "`tools/scoreboard` makes this page, [scoreboard.csv](scoreboard.csv) and the plot again.\n\n"
    "![Captured share over cost](scoreboard.svg)\n\n";

int fail(const std::string& message) {
    std::fprintf(stderr, "scoreboard: %s\n", message.c_str());
    return 1;
}

Result<Comparison> compare(gpu::Device& device, Renderer& renderer, const std::string& name,
                           const Scene& scene, const std::vector<Contestant>& contestants,
                           const ComparisonSettings& settings) {
    Progress line(name, 0);
    Result<Comparison> comparison = compare_techniques(
        device, renderer, built_in_catalog(), scene, contestants, settings,
        {.progress = [&](double done, const std::string& what) { line.set(done, name + ": " + what); }});
    if (!comparison) return comparison;
    const auto print = [&](Integrator integrator, const EffectReference& reference) {
        std::printf("%s: reference %s of %d samples a pixel in %.0f s%s, noise %.2f of the effect%s\n",
                    name.c_str(), std::string(judge_name(integrator)).c_str(), reference.samples,
                    reference.time_ms / 1000, reference.from_cache ? " (from the cache)" : "",
                    reference.noise.noise_rms / reference.noise.effect_rms,
                    reference.reached ? "" : ": not as fine as asked for");
    };
    print(comparison->integrator, comparison->reference);
    if (comparison->second) print(*comparison->second_integrator, *comparison->second);
    return comparison;
}

// Of a scene without a clip, or of the frames of its clip. The scene moves with them.
Result<std::vector<ScoreRow>> compared_rows(gpu::Device& device, const std::string& name, Scene& scene,
                                            const std::vector<Contestant>& contestants,
                                            const ComparisonSettings& settings) {
    DERMIS_TRY_ASSIGN(Renderer renderer,
                      Renderer::create(device, gpu::embedded_shaders(built_in_catalog().shaders), scene));
    if (scene.motion.clip.empty()) {
        DERMIS_TRY_ASSIGN(const Comparison made,
                          compare(device, renderer, name, scene, contestants, settings));
        return score_rows(name, made);
    }
    ComparedFrames frames;
    for (int i = 0; i < kClipFrames; ++i) {
        const double time_s = kClipStart_s + i / kClipFramesPerS;
        if (i > 0) DERMIS_TRY(move_scene(time_s, scene, renderer));
        DERMIS_TRY_ASSIGN(const Comparison made,
                          compare(device, renderer, name, scene, contestants, settings));
        DERMIS_TRY(frames.add(name, time_s, made));
    }
    return rows_of_clip(name, frames.all);
}

// Everything that a scene's rows depend on: this program with its shaders and techniques, the scene, the
// settings.
Result<std::string> rows_hash(const Scene& scene, const std::vector<Contestant>& contestants,
                              const ComparisonSettings& settings) {
    const Result<std::vector<std::byte>> program = read_file("/proc/self/exe");
    if (!program) return program.error();
    ReferenceSettings reference = settings.reference;
    reference.width = settings.width;
    reference.height = settings.height;
    DERMIS_TRY_ASSIGN(const std::string hash, reference_hash(scene, reference));
    Hasher hasher;
    for (const Contestant& contestant : contestants) hasher.add(std::string_view(contestant.name()));
    return hasher.add(std::span(*program))
        .add(std::string_view(hash))
        .add(settings.second.has_value())
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

// The table of a set of test scenes has shares alone.
bool shows_cost(const Job& job) {
    return !job.made;
}

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

Result<void> look_at(Scene& scene, std::string_view view) {
    const auto found = std::ranges::find(kNearViews, view, &NearView::name);
    if (found == std::end(kNearViews)) return Error{"@" + std::string(view) + ": no such view"};
    scene.camera = place_camera({.target_mm = found->target_mm,
                                 .yaw_deg = found->yaw_deg,
                                 .pitch_deg = kNearPitchDeg,
                                 .distance_mm = kNearDistanceMm,
                                 .fov_deg = kNearFovDeg},
                                scene.bounds_center_mm, scene.bounds_radius_mm);
    return {};
}

// Empty: the scene does not move.
std::string clip_of(const std::string& name) {
    const size_t space = name.find(' ');
    return space == std::string::npos ? "" : name.substr(space + 1);
}

Result<SubjectCase> scene_of(Job& job) {
    if (!job.made) {
        const size_t slash = job.name.find('/');
        const std::string head = job.name.substr(0, job.name.find_first_of("/ ")), clip = clip_of(job.name);
        const size_t at = head.find('@');
        SceneOptions options{.subjects = built_in_catalog().subjects};
        if (!clip.empty())
            options.words = {{"animation.clip", clip}, {"animation.time_s", to_text(kClipStart_s)}};
        Result<Scene> scene = load_scene(head.substr(0, at), options);
        if (!scene) return scene.error();
        if (at != std::string::npos) DERMIS_TRY(look_at(*scene, std::string_view(head).substr(at + 1)));
        if (slash != std::string::npos) {
            const std::string profile = job.name.substr(slash + 1);
            if (const Result<Profile> found = find_profile(profile); !found) return found.error();
            scene->skin.profile = profile;
        }
        job.made = {.name = job.name, .scene = std::move(*scene)};
    }
    if (Result<void> complete = complete_scene(job.made->scene); !complete) return complete.error();
    return std::move(*job.made);
}

struct MadeRows {
    std::vector<ScoreRow> rows;
    bool from_cache = false;
};

// From the cache, or computed and stored there.
Result<MadeRows> rows_of(gpu::Device& device, const std::string& name, Scene& scene,
                         const std::vector<Contestant>& contestants, const ComparisonSettings& settings) {
    const Result<std::string> hash = rows_hash(scene, contestants, settings);
    if (!hash) return hash.error();
    if (const auto bytes = cache_load("scoreboard", *hash)) {
        std::printf("%s: was made before\n", name.c_str());
        Result<std::vector<ScoreRow>> rows =
            parse_scores({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
        if (!rows) return rows.error();
        return MadeRows{std::move(*rows), true};
    }
    Result<std::vector<ScoreRow>> rows = compared_rows(device, name, scene, contestants, settings);
    if (!rows) return rows.error();
    const std::string text = scores_csv(*rows);
    const auto bytes = std::as_bytes(std::span(text));
    cache_store("scoreboard", *hash, {bytes.begin(), bytes.end()});
    return MadeRows{std::move(*rows), false};
}

Result<std::vector<ScoreRow>> kept_rows(const std::filesystem::path& csv) {
    std::error_code ec;
    if (!std::filesystem::exists(csv, ec)) return std::vector<ScoreRow>();
    const Result<std::string> text = read_text_file(csv);
    if (!text) return text.error();
    return parse_scores(*text);
}

// Of one scene; never cached, as they follow the shaders and take seconds.
Result<void> set_models(gpu::Device& device, const Scene& scene, std::span<ScoreRow> rows) {
    const Result<const Card*> card = find_card(kModelChip);
    if (!card) return card.error();
    return set_model_ratios(device, built_in_catalog(), scene, rows, kModelWidth, kModelHeight, **card);
}

Result<void> write(const std::filesystem::path& directory, const std::vector<ScoreRow>& rows,
                   const std::string& device, int size) {
    char heading[2048];
    const Result<const Card*> card = find_card(kModelChip);
    if (!card) return card.error();
    std::snprintf(heading, sizeof heading, kText, device.c_str(), size, size,
                  std::string((*card)->name).c_str(), kModelWidth, kModelHeight);
    if (auto done = write_text_file(directory / "scoreboard.csv", scores_csv(rows)); !done) return done;
    if (auto done = write_plot(directory / "scoreboard.svg", scoreboard_plot(rows)); !done) return done;
    return write_text_file(directory / "scoreboard.md", heading + scoreboard_markdown(rows));
}

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// Scenes that were in the cache say nothing of how long the others take.
void print_what_is_left(size_t left, size_t all, double made_s, size_t made) {
    if (left == 0) return;
    std::printf("%zu of %zu scenes are left", left, all);
    if (made > 0)
        std::printf(", about %.0f min if they take as long", made_s / double(made) * double(left) / 60);
    std::printf("\n");
}

ComparisonSettings settings_of(const Job& job, int size) {
    const bool moves = !clip_of(job.name).empty();
    const int side = job.made ? std::min(size, kCaseSize) : moves ? std::min(size, kClipSize) : size;
    ComparisonSettings settings = comparison_settings(side, side);
    settings.noise = moves ? kClipNoise : kNoiseShare * noise_of_size(side, side);
    if (!job.made && side > kCoarseSide) settings.walks = kFewWalks;
    settings.frames = 2;
    settings.reference.integrator = Integrator::walk;
    settings.second = Integrator::surface;
    return settings;
}

Result<void> make_board(gpu::Device& device, const std::filesystem::path& directory, int size,
                        std::vector<Job> jobs, const std::vector<Contestant>& contestants,
                        MergedRows replaced) {
    Result<std::vector<ScoreRow>> rows = kept_rows(directory / "scoreboard.csv");
    if (!rows) return rows.error();
    double made_s = 0;
    size_t made = 0;
    for (size_t i = 0; i < jobs.size(); ++i) {
        const bool with_cost = shows_cost(jobs[i]);  // scene_of() makes it
        ComparisonSettings own = settings_of(jobs[i], size);
        const Clock::time_point start = Clock::now();
        Result<SubjectCase> one = scene_of(jobs[i]);
        if (!one) {
            std::printf("%s is passed over, its rows stay: %s\n", jobs[i].name.c_str(),
                        one.error().message.c_str());
            continue;
        }
        own.exact = one->exact;
        Result<MadeRows> now = rows_of(device, one->name, one->scene, contestants, own);
        if (!now) return Error{one->name + ": " + now.error().message};
        if (with_cost && gpu::null_driver_installed())
            if (Result<void> set = set_models(device, one->scene, now->rows); !set)
                return set.error().within(one->name);
        rows = merged(std::move(*rows), now->rows, replaced);
        if (Result<void> written = write(directory, *rows, device.info().name, size); !written)
            return written;
        if (!now->from_cache) {
            made_s += seconds_since(start);
            ++made;
        }
        print_what_is_left(jobs.size() - i - 1, jobs.size(), made_s, made);
    }
    return {};
}

// The modelled costs of rows that are kept as they are.
Result<void> model_board(gpu::Device& device, const std::filesystem::path& directory, int size,
                         std::vector<Job> jobs) {
    Result<std::vector<ScoreRow>> rows = kept_rows(directory / "scoreboard.csv");
    if (!rows) return rows.error();
    for (Job& job : jobs) {
        if (!shows_cost(job)) continue;
        const auto is_own = [&job](const ScoreRow& row) { return row.scene == job.name; };
        // Rows of a scene are together (merged()).
        const auto first = std::ranges::find_if(*rows, is_own);
        const std::span own(first, std::find_if_not(first, rows->end(), is_own));
        if (own.empty()) continue;
        const std::string name = job.name;
        const Result<SubjectCase> one = scene_of(job);
        if (!one) return one.error().within(name);
        if (Result<void> set = set_models(device, one->scene, own); !set) return set.error().within(name);
        std::printf("%s: costs modelled\n", name.c_str());
    }
    return write(directory, *rows, device.info().name, size);
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> words(argv + 1, argv + argc);
    const bool models_only = std::erase(words, "--models") > 0;
    std::vector<Contestant> contestants = scoreboard_contestants(built_in_catalog().techniques);
    MergedRows replaced = MergedRows::scenes;
    if (const auto flag = std::ranges::find(words, "--techniques"); flag != words.end()) {
        if (flag + 1 == words.end()) return fail("--techniques needs a list");
        Result<std::vector<Contestant>> list =
            parse_technique_list(built_in_catalog().techniques, *(flag + 1));
        if (list) list = with_cost_base(std::move(*list), built_in_catalog().techniques);
        if (!list) return fail(list.error().message);
        contestants = std::move(*list);
        replaced = MergedRows::techniques;
        words.erase(flag, flag + 2);
    }
    if (words.empty() || std::ranges::any_of(words, [](const auto& word) { return word.starts_with("-"); }))
        return fail("usage: scoreboard_bench DIRECTORY [SIZE] [SCENE...] [--techniques LIST] [--models]");
    if (models_only && words.size() < 2) return fail("--models needs the size that the board was made with");
    const int size = words.size() > 1 ? std::atoi(words[1].c_str()) : 384;
    if (size < 16 || size > 4096) return fail("a size of 16 to 4096");
    std::vector<std::string> names(words.begin() + std::min<std::ptrdiff_t>(std::ssize(words), 2),
                                   words.end());
    if (names.empty()) names.assign(std::begin(kScenes), std::end(kScenes));
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    Result<gpu::Device> device = gpu::Device::create({});
    if (!device) return fail(device.error().message);
    Result<std::vector<Job>> jobs = jobs_of(names);
    if (!jobs) return fail(jobs.error().message);
    if (!gpu::null_driver_installed())
        std::fprintf(stderr, "scoreboard: Mesa's RADV is not installed: no modelled costs\n");
    const Result<void> done =
        models_only ? model_board(*device, words[0], size, std::move(*jobs))
                    : make_board(*device, words[0], size, std::move(*jobs), contestants, replaced);
    return done ? 0 : fail(done.error().message);
}
