// `dermis reference`: the ground truth of a scene as a layered EXR.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "dermis/base/file.h"
#include "dermis/base/progress.h"
#include "dermis/base/text.h"
#include "dermis/image/io.h"
#include "dermis/image/tone_map.h"
#include "dermis/reference/picture.h"
#include "dermis/render/complete_scene.h"
#include "render_options.h"

namespace dermis::cli {
namespace {

struct Options {
    SceneChoice scene;
    std::string output, preview, size = "512x512", profile;
    std::string integrator = "surface", filter = "box", shadows = "scene", ambient = "traced",
                specular = "ggx";
    std::string normalisation = "area", cavities = "flesh", medium;
    int samples = 0, probes = 16;  // 0: kSamples, or as many as the noise takes
    uint32_t seed = 1;
    double noise = 0, width_scale = 1;
    float penumbra_mm = 2;
    bool json = false;
};

constexpr int kSamples = 64, kMostSamples = 65536;
// The picture is written, but noisier than asked.
constexpr int kNoiseMissed = 3;

// Set by Ctrl-C or a request to end: the picture so far is written, then the program ends. A second one ends
// it at once. The signal, or 0.
std::atomic<int> g_signal = 0;
std::atomic<bool> g_stop = false;

extern "C" void stop_on_signal(int signal) {
    g_signal = signal;
    g_stop = true;
    std::signal(signal, SIG_DFL);
}

// While it exists, the signals only ask to stop.
class StopOnSignals {
  public:
    StopOnSignals()
        : interrupt_(std::signal(SIGINT, stop_on_signal)), terminate_(std::signal(SIGTERM, stop_on_signal)) {}
    ~StopOnSignals() {
        std::signal(SIGINT, interrupt_);
        std::signal(SIGTERM, terminate_);
    }
    StopOnSignals(const StopOnSignals&) = delete;
    StopOnSignals& operator=(const StopOnSignals&) = delete;

  private:
    void (*interrupt_)(int);
    void (*terminate_)(int);
};

// Before the work rather than after it.
Result<void> try_outputs(const Options& options) {
    if (to_lower(std::filesystem::path(options.output).extension().string()) != ".exr")
        return Error{"-o " + options.output + ": the ground truth is linear and layered; name a .exr file"};
    if (Result<void> tried = try_output(options.output); !tried) return tried;
    if (options.preview.empty()) return {};
    const std::string extension = std::filesystem::path(options.preview).extension().string();
    if (const auto encoded = encode_image(extension, Image(1, 1, 3, PixelFormat::u8, Encoding::srgb), {});
        !encoded)
        return Error{"--preview " + options.preview + ": " + encoded.error().message};
    return try_output(options.preview);
}

template <class Enum>
struct Named {
    std::string_view name;
    Enum value;
};

template <class Enum, size_t N>
Result<Enum> choose(std::string_view what, const std::string& text, const Named<Enum> (&all)[N]) {
    std::vector<std::string> names;
    for (const Named<Enum>& one : all) {
        if (one.name == text) return one.value;
        names.emplace_back(one.name);
    }
    return Error{unknown_name(what, text, names)};
}

constexpr Named<Integrator> kIntegrators[] = {
    {"surface", Integrator::surface}, {"walk", Integrator::walk}, {"lambert", Integrator::lambert}};
constexpr Named<PixelFilter> kFilters[] = {{"box", PixelFilter::box}, {"center", PixelFilter::center}};
constexpr Named<ShadowCasters> kShadows[] = {{"scene", ShadowCasters::scene}, {"all", ShadowCasters::all}};
constexpr Named<AmbientModel> kAmbient[] = {{"traced", AmbientModel::traced},
                                            {"renderer", AmbientModel::renderer}};
constexpr Named<SpecularReflection> kSpecular[] = {{"none", SpecularReflection::none},
                                                   {"blinn_phong", SpecularReflection::blinn_phong},
                                                   {"ggx", SpecularReflection::ggx}};
constexpr Named<Normalisation> kNormalisations[] = {{"area", Normalisation::by_area},
                                                    {"none", Normalisation::none}};
constexpr Named<Cavities> kCavities[] = {{"flesh", Cavities::flesh}, {"open", Cavities::open}};

template <class Enum, size_t N>
Result<void> set(Enum& target, std::string_view what, const std::string& text, const Named<Enum> (&all)[N]) {
    const Result<Enum> value = choose(what, text, all);
    if (!value) return value.error();
    target = *value;
    return {};
}

// "sigma_s=1,2,3 sigma_a=.1,.2,.3 g=0 eta=1.4", 1/mm; one number is used for all three channels.
Result<ScatteringMedium> parse_medium(const std::string& text) {
    const auto wrong = [&](std::string_view part) {
        return Error{"--medium: '" + std::string(part) +
                     "' is not one of sigma_s=R,G,B sigma_a=R,G,B (1/mm) g=VALUE eta=VALUE"};
    };
    ScatteringMedium medium;
    for (const std::string_view part : split(text, ' ')) {
        if (part.empty()) continue;
        const std::vector<std::string_view> pair = split(part, '=');
        if (pair.size() != 2) return wrong(part);
        std::vector<double> numbers;
        for (const std::string_view word : split(pair[1], ',')) {
            const std::optional<double> number = parse_number(trim(word));
            if (!number) return wrong(part);
            numbers.push_back(*number);
        }
        const bool is_sigma = pair[0] == "sigma_s" || pair[0] == "sigma_a";
        if (numbers.size() != 1 && !(is_sigma && numbers.size() == 3)) return wrong(part);
        numbers.resize(3, numbers[0]);
        if (pair[0] == "sigma_s")
            medium.sigma_s_per_mm = {numbers[0], numbers[1], numbers[2]};
        else if (pair[0] == "sigma_a")
            medium.sigma_a_per_mm = {numbers[0], numbers[1], numbers[2]};
        else if (pair[0] == "g")
            medium.g = numbers[0];
        else if (pair[0] == "eta")
            medium.eta = numbers[0];
        else
            return wrong(part);
    }
    return medium;
}

Result<ReferenceSettings> settings_of(const Options& options) {
    const int samples = options.samples != 0 ? options.samples : options.noise != 0 ? kMostSamples : kSamples;
    ReferenceSettings settings{.samples = samples,
                               .seed = options.seed,
                               .probes = options.probes,
                               .width_scale = options.width_scale};
    settings.lighting.penumbra_mm = options.penumbra_mm;
    if (options.noise != 0) settings.noise = options.noise;
    const Result<Size> size = parse_size(options.size);
    if (!size) return size.error();
    settings.width = size->width;
    settings.height = size->height;
    for (const Result<void>& step :
         {set(settings.integrator, "integrator", options.integrator, kIntegrators),
          set(settings.filter, "pixel filter", options.filter, kFilters),
          set(settings.normalisation, "normalisation", options.normalisation, kNormalisations),
          set(settings.cavities, "cavities", options.cavities, kCavities),
          set(settings.lighting.shadows, "choice of shadows", options.shadows, kShadows),
          set(settings.lighting.ambient, "ambient model", options.ambient, kAmbient),
          set(settings.lighting.specular, "specular model", options.specular, kSpecular)})
        if (!step) return step.error();
    if (!options.medium.empty()) {
        Result<ScatteringMedium> medium = parse_medium(options.medium);
        if (!medium) return medium.error();
        settings.medium = *medium;
    }
    return settings;
}

Result<Scene> scene_of(const Options& options) {
    Result<Scene> scene = options.scene.load();
    if (!scene) return scene;
    // The renderer's approximation wants the vertices' occlusion.
    if (options.ambient == "renderer")
        if (Result<void> completed = complete_scene(*scene); !completed) return completed.error();
    if (!options.profile.empty()) scene->skin.profile = options.profile;
    return scene;
}

nlohmann::ordered_json description(const Options& options, const ReferenceSettings& settings,
                                   const ReferencePicture& picture, bool stopped) {
    return {{"scene", options.scene.name},
            {"integrator", options.integrator},
            {"width", settings.width},
            {"height", settings.height},
            {"passes", picture.passes},
            {"probes", settings.probes},
            {"seed", settings.seed},
            {"filter", options.filter},
            {"shadows", options.shadows},
            {"ambient", options.ambient},
            {"specular", options.specular},
            {"normalisation", options.normalisation},
            {"cavities", options.cavities},
            {"width_scale", settings.width_scale},
            {"penumbra_mm", options.penumbra_mm},
            {"relative_error", picture.relative_error},
            {"noise_reached", picture.reached_noise},
            {"stopped", stopped},
            {"warnings", picture.warnings}};
}

Result<void> write_picture(const Options& options, const Scene& scene, const ReferencePicture& picture,
                           const std::string& text) {
    const ImageLayer layers[] = {{"", picture.radiance},         {"diffuse", picture.diffuse},
                                 {"specular", picture.specular}, {"variance", picture.variance},
                                 {"samples", picture.samples},   {"skin", picture.skin}};
    ImageText inside = {{"dermis", text}};
    if (!scene.credit.empty()) inside["credit"] = scene.credit;
    return write_layered_exr(options.output, layers, inside);
}

// For the eye: the scene's own exposure and tone map, 8 bits.
Result<void> write_preview(const Options& options, const Scene& scene, const ReferencePicture& picture) {
    if (options.preview.empty()) return {};
    const Image shown = tone_mapped(picture.radiance, scene.tone_map, std::exp2(scene.exposure_ev));
    Image opaque(shown.width, shown.height, 3);
    for (size_t i = 0; i < opaque.pixel_count(); ++i)
        std::copy_n(&shown.floats()[4 * i], 3, &opaque.floats()[3 * i]);
    const ImageText text = scene.credit.empty() ? ImageText{} : ImageText{{"credit", scene.credit}};
    return write_image(options.preview, convert(opaque, PixelFormat::u8, Encoding::srgb), text);
}

Result<int> run(const Options& options) {
    const Result<ReferenceSettings> settings = settings_of(options);
    if (!settings) return settings.error();
    if (Result<void> tried = try_outputs(options); !tried) return tried.error();
    const Result<Scene> scene = scene_of(options);
    if (!scene) return scene.error();
    Result<ReferencePicture> picture = [&] {
        const StopOnSignals stop;
        constexpr double kSteps = 1000;
        Progress line("ground truth", size_t(kSteps));
        size_t shown = 0;
        return render_reference(
            *scene, *settings,
            [&](double done) {
                const auto now = size_t(done * kSteps);
                if (now > shown) line.advance(now - shown);
                shown = std::max(shown, now);
            },
            &g_stop);
    }();
    if (!picture) return picture.error();
    picture->warnings.insert(picture->warnings.begin(), scene->warnings.begin(), scene->warnings.end());
    nlohmann::ordered_json json = description(options, *settings, *picture, g_stop);
    if (Result<void> written = write_picture(options, *scene, *picture, json.dump()); !written)
        return written.error();
    json["time_ms"] = picture->time_ms;  // not in the file: the same seed gives the same bytes
    if (Result<void> written = write_preview(options, *scene, *picture); !written) return written.error();
    for (const std::string& warning : picture->warnings) print_warning(warning);
    if (options.json)
        std::printf("%s\n", json.dump(2).c_str());
    else
        std::printf("%s: %s%d passes, relative error %.4f, %.1f s%s%s\n", options.output.c_str(),
                    g_stop ? "stopped after " : "", picture->passes, picture->relative_error,
                    picture->time_ms / 1000, scene->credit.empty() ? "" : "\n", scene->credit.c_str());
    if (g_stop) return 128 + g_signal;
    if (picture->reached_noise) return 0;
    std::fprintf(stderr,
                 "dermis: the relative error is %.4f after %d samples a pixel, not the %g of --noise: raise "
                 "--samples\n",
                 picture->relative_error, picture->passes, options.noise);
    return kNoiseMissed;
}

}  // namespace

void add_reference_command(CommandLine& line) {
    auto options = std::make_shared<Options>();
    Command* command = line.add(
        "reference", "Renders the ground truth of a scene: surface integral of the profile, or random walks",
        "dermis reference head_scan -o truth.exr --noise 0.01\n"
        "  dermis reference head_scan --integrator walk --profile jensen_skin1 --samples 256 -o walk.exr\n"
        "  layers: R,G,B,A radiance and coverage; diffuse; specular; variance of the mean; samples; skin\n"
        "  Ctrl-C (or SIGTERM) writes the picture so far and prints its error\n"
        "  exit code 3: the picture is written, but --samples ended it before --noise was reached");
    options->scene.add_to(*command)->required();
    command->add_option("-o,--output", options->output, "FILE.exr")->required();
    command->add_option("--preview", options->preview, "FILE.png: the picture with the scene's tone map");
    command->add_option("--size", options->size, "WIDTHxHEIGHT")->capture_default_str();
    command->add_option("--integrator", options->integrator, "integrator: surface, walk or lambert")
        ->capture_default_str();
    command->add_option("--samples,--spp", options->samples,
                        "maximum samples a pixel (default: 64; with --noise as many as it needs)");
    command->add_option("--noise", options->noise, "stop at this relative error, such as 0.01");
    command
        ->add_option("--seed", options->seed,
                     "seed of the random numbers; the same seed gives the same picture")
        ->capture_default_str();
    command->add_option("--probes", options->probes, "probes or walks for each sample, an even number")
        ->capture_default_str();
    command->add_option("--profile", options->profile, "diffusion profile instead of the scene's");
    command->add_option(
        "--medium", options->medium,
        "walk: \"sigma_s=1,1,1 sigma_a=.1,.1,.1 g=0 eta=1.4\" in 1/mm instead of the profile's");
    command
        ->add_option("--width-scale", options->width_scale,
                     "factor on the lengths of profile or medium; 0 is Lambert")
        ->capture_default_str();
    command
        ->add_option("--normalisation", options->normalisation,
                     "normalisation of the surface integral: area or none")
        ->capture_default_str();
    command
        ->add_option("--cavities", options->cavities,
                     "cavities not visible from outside: flesh, or open as in the mesh")
        ->capture_default_str();
    command
        ->add_option("--filter", options->filter,
                     "pixel filter: box, or center (one point, as without multisampling)")
        ->capture_default_str();
    command->add_option("--shadows", options->shadows, "lights that cast shadows: key or all")
        ->capture_default_str();
    command
        ->add_option("--ambient", options->ambient,
                     "environment: traced, or renderer (the renderer's approximation)")
        ->capture_default_str();
    command->add_option("--specular", options->specular, "specular model: ggx, blinn_phong or none")
        ->capture_default_str();
    command->add_option("--penumbra-mm", options->penumbra_mm, "width of the key light's shadow edge")
        ->capture_default_str();
    command->add_flag("--json", options->json, "print one JSON object");
    line.when_chosen(command, [options] { return run(*options); });
}

}  // namespace dermis::cli
