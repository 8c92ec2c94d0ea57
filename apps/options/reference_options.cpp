#include "reference_options.h"

#include <nlohmann/json.hpp>

#include "dermis/base/text.h"
#include "dermis/judge/reference_cache.h"
#include "dermis/render/complete_scene.h"
#include "render_options.h"

namespace dermis::cli {
namespace {

constexpr NumberRange kSamplesRange = {2, kMostSamples}, kProbesRange = {1, 65536};

constexpr int kSamples = 64;

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
    DERMIS_TRY_ASSIGN(const Enum value, choose(what, text, all));
    target = value;
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

}  // namespace

Result<FileUse> ReferenceOptions::files() const {
    return picture_files(output, preview, {scene.name, profile});
}

Result<ReferenceSettings> ReferenceOptions::settings() const {
    const int passes = samples != 0 ? samples : noise != 0 ? kMostSamples : kSamples;
    ReferenceSettings chosen{.samples = passes, .seed = seed, .probes = probes, .width_scale = width_scale};
    chosen.lighting.penumbra_mm = penumbra_mm;
    if (noise != 0) chosen.noise = noise;
    for (const Result<void>& in_range :
         {check_number("--samples", passes, kSamplesRange),
          probes == 0 ? Result<void>{} : check_number("--probes", probes, kProbesRange)})
        if (!in_range) return in_range.error();
    DERMIS_TRY_ASSIGN(const Size pixels, parse_size(size));
    chosen.width = pixels.width;
    chosen.height = pixels.height;
    for (const Result<void>& step :
         {set(chosen.integrator, "integrator", integrator, kIntegrators),
          set(chosen.filter, "pixel filter", filter, kFilters),
          set(chosen.normalisation, "normalisation", normalisation, kNormalisations),
          set(chosen.cavities, "cavities", cavities, kCavities),
          set(chosen.lighting.shadows, "choice of shadows", shadows, kShadows),
          set(chosen.lighting.ambient, "ambient model", ambient, kAmbient),
          set(chosen.lighting.specular, "specular model", specular, kSpecular)})
        if (!step) return step.error();
    if (chosen.integrator == Integrator::lambert && !profile.empty())
        return Error{"--profile has no effect on --integrator lambert, which scatters nothing"};
    if (chosen.cavities != Cavities::flesh && chosen.integrator != Integrator::walk)
        return Error{"--cavities has no effect on --integrator " + integrator + "; add --integrator walk"};
    if (!medium.empty()) {
        DERMIS_TRY_ASSIGN(ScatteringMedium parsed, parse_medium(medium));
        chosen.medium = parsed;
        if (chosen.integrator != Integrator::walk)
            return Error{"--medium has no effect on --integrator " + integrator +
                         ", which reads the scene's profile; add --integrator walk"};
    }
    return chosen;
}

Result<std::optional<SampleRange>> ReferenceOptions::range(const ReferenceSettings& settings) const {
    if (sample_range.empty()) return std::optional<SampleRange>();
    DERMIS_TRY_ASSIGN(const IndexRange parsed, parse_index_range("--sample-range", sample_range));
    const SampleRange chosen = {parsed.begin, parsed.end};
    if (Result<void> good = check_range(settings, chosen); !good)
        return Error{"--sample-range " + sample_range + ": " + good.error().message};
    if (!preview.empty())
        return Error{"--preview " + preview +
                     ": a part of a picture has none; dermis merge --preview makes it"};
    return std::optional(chosen);
}

Result<Scene> ReferenceOptions::load_scene() const {
    Result<Scene> loaded = scene.load();
    if (!loaded) return loaded;
    // The renderer's approximation needs the vertices' occlusion.
    if (ambient == "renderer") DERMIS_TRY(complete_scene(*loaded));
    if (!profile.empty()) loaded->skin.profile = profile;
    if (!output.empty()) DERMIS_TRY(keep_scene_files(*loaded, files()));
    return loaded;
}

PictureFacts ReferenceOptions::facts(const ReferenceSettings& settings, const Scene& loaded) const {
    // Null: values that only the picture knows; the order stays.
    const nlohmann::ordered_json facts_json = {
        {"scene", scene.name},       {"integrator", integrator},
        {"width", settings.width},   {"height", settings.height},
        {"passes", nullptr},         {"probes", probes_of(settings)},
        {"seed", settings.seed},     {"filter", filter},
        {"shadows", shadows},        {"ambient", ambient},
        {"specular", specular},      {"normalisation", normalisation},
        {"cavities", cavities},      {"width_scale", settings.width_scale},
        {"penumbra_mm", penumbra_mm}};
    return {.description = facts_json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace),
            .credit = loaded.credit,
            .scene_warnings = loaded.warnings,
            .tone_map = loaded.tone_map,
            .exposure_ev = loaded.exposure_ev};
}

Result<std::string> content_hash(const Scene& scene, ReferenceSettings settings) {
    settings.samples = 0;
    return reference_hash(scene, settings);
}

void ReferenceOptions::add_to(Command& command) {
    scene.add_to(command)->required();
    command.add_output("-o,--output", output, "FILE.exr")->required();
    command.add_output("--preview", preview, "FILE.png: the picture with the scene's tone map");
    command.add_option("--size", size, "WIDTHxHEIGHT")->capture_default_str();
    command.add_option("--integrator", integrator, "integrator: surface, walk or lambert")
        ->capture_default_str();
    command.add_option("--samples,--spp", samples, kSamplesRange,
                       "maximum samples a pixel (default: 64; with --noise as many as it needs)");
    command.add_option("--sample-range", sample_range,
                       "BEGIN:END: write the sums over these of the --samples as a part for dermis merge");
    command.add_option("--noise", noise, {1e-6, 0.999999}, "stop at this relative error, such as 0.01");
    command
        .add_option("--seed", seed, {0, 4294967295},
                    "seed of the random numbers; the same seed gives the same picture")
        ->capture_default_str();
    command.add_option("--probes", probes, kProbesRange,
                       "probes or walks for each sample; without it 3 probes or 16 walks");
    command.add_option("--profile", profile, "diffusion profile instead of the scene's");
    command.add_option(
        "--medium", medium,
        "walk: \"sigma_s=1,1,1 sigma_a=.1,.1,.1 g=0 eta=1.4\" in 1/mm instead of the profile's");
    command
        .add_option("--width-scale", width_scale, {0, 1000},
                    "factor on the lengths of profile or medium; 0 is Lambert")
        ->capture_default_str();
    command
        .add_option("--normalisation", normalisation, "normalisation of the surface integral: area or none")
        ->capture_default_str();
    command
        .add_option("--cavities", cavities,
                    "cavities not visible from outside: flesh, or open as in the mesh")
        ->capture_default_str();
    command
        .add_option("--filter", filter, "pixel filter: box, or center (one point, as without multisampling)")
        ->capture_default_str();
    command.add_option("--shadows", shadows, "lights that cast shadows: key or all")->capture_default_str();
    command
        .add_option("--ambient", ambient, "environment: traced, or renderer (the renderer's approximation)")
        ->capture_default_str();
    command.add_option("--specular", specular, "specular model: ggx, blinn_phong or none")
        ->capture_default_str();
    command.add_option("--penumbra-mm", penumbra_mm, {0, 1000}, "width of the key light's shadow edge")
        ->capture_default_str();
    command.add_flag("--json", json, "print one JSON object");
}

}  // namespace dermis::cli
