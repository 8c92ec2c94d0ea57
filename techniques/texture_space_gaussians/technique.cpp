// d'Eon, Luebke 2007, "Advanced Techniques for Realistic Real-Time Skin Rendering" (GPU Gems 3, chapter 14):
// the light map is blurred by each Gaussian of the diffusion profile, each from the one before, in two
// passes along the surface, and the results are summed by the profile's weights. Changed: the steps of the
// blur follow shear as well as stretch and agree across seams (shaders/atlas/blur_mm.glsl); gutter texels
// hold the light from across the UV seam; the sum is accumulated by blending, so that any number of Gaussians
// needs four images; what is too small for the texels is lit at the pixel (detail=pixel); transmission is
// summed from the shadow map itself. The energy that the specular takes is an option of the scene.

#include <algorithm>
#include <cmath>

#include "dermis/technique/atlas_light.h"
#include "dermis/technique/forward.h"

namespace dermis {
namespace {

constexpr const char* kOwnView = "light_map";

struct Params {
    AtlasParams atlas;
    float width = 1;
    int32_t half_taps = 3;
    bool carry_seams = true;
    float pre_scatter = 0;
    SpecularModel specular = SpecularModel::ggx;
};

ParameterTable parameters() {
    return ParameterTableBuilder<Params>()
        .part(&Params::atlas, atlas_parameters())
        .number(&Params::width, "width", "", 0, 10, "scales the profile's lengths")
        .integer(&Params::half_taps, "half_taps", "", 2, 12, "taps on each side of a Gaussian's centre")
        .toggle(&Params::carry_seams, "carry_seams",
                "blur across the atlas's seams; off: taps that leave a chart are dropped")
        .number(&Params::pre_scatter, "pre_scatter", "", 0, 1,
                "exponent of the base colour before the blur; the rest is applied after it")
        .choice(&Params::specular, "specular", specular_model_names(), "specular model")
        .build();
}

// From a tap to the next (spacing() in gaussian.glsl), in sigmas, with the fewest taps.
constexpr float kLongestTapSigmas = 1.6f;

// One step of the blur: from the variance before to this one, and its share of the profile.
struct Step {
    double variance_mm2 = 0, sigma_mm = 0;
    Vec3 share;
};

// Terms narrower than this part of a texel take one blur together: a texel cannot tell them apart. Captured
// share of the bust .822 without, .821 with .5, .803 with .8 (light map 512, texel 1.0 mm, light crossing
// folds).
constexpr double kToldApartTexels = 0.5;

// Those up to `variance_mm2` as one, of their mean variance over all channels.
std::vector<GaussianTerm> narrow_terms_joined(std::vector<GaussianTerm> sorted, double variance_mm2) {
    const auto wide = std::ranges::find_if(
        sorted, [&](const GaussianTerm& term) { return term.variance_mm2 > variance_mm2; });
    if (wide - sorted.begin() < 2) return sorted;
    GaussianTerm joined = {.variance_mm2 = 0, .weight = {0, 0, 0}};
    double sum = 0;
    for (auto term = sorted.begin(); term != wide; ++term)
        for (size_t c = 0; c < 3; ++c) {
            joined.weight[c] += term->weight[c];
            joined.variance_mm2 += term->weight[c] * term->variance_mm2;
            sum += term->weight[c];
        }
    joined.variance_mm2 /= std::max(sum, 1e-9);
    sorted.erase(sorted.begin() + 1, wide);
    sorted.front() = joined;
    return sorted;
}

// The profile's terms, narrowest first, equal variances together; shares sum to 1 per channel, as albedo lies
// in the base colour.
std::vector<Step> steps_of(const GaussianSum& sum, float width, double texel_mm) {
    std::vector<GaussianTerm> terms = sum.terms;
    std::ranges::sort(terms, {}, &GaussianTerm::variance_mm2);
    const double narrow_mm = kToldApartTexels * texel_mm / std::max(double(width), 1e-6);
    terms = narrow_terms_joined(std::move(terms), narrow_mm * narrow_mm);
    double total[3] = {0, 0, 0};
    for (const GaussianTerm& term : terms)
        for (int c = 0; c < 3; ++c) total[c] += term.weight[size_t(c)];
    std::vector<Step> steps;
    double before_mm2 = 0;
    for (const GaussianTerm& term : terms) {
        const auto share = [&](size_t c) { return total[c] > 0 ? float(term.weight[c] / total[c]) : 0.0f; };
        const Vec3 own = {share(0), share(1), share(2)};
        if (!steps.empty() && term.variance_mm2 <= steps.back().variance_mm2 * (1 + 1e-9)) {
            steps.back().share += own;
            continue;
        }
        steps.push_back({.variance_mm2 = term.variance_mm2,
                         .sigma_mm = width * std::sqrt(term.variance_mm2 - before_mm2),
                         .share = own});
        before_mm2 = term.variance_mm2;
    }
    return steps;
}

AtlasLightSettings atlas_settings(const Params& params, const std::vector<Step>& steps,
                                  const FrameContext& frame) {
    AtlasLightSettings settings = atlas_light_settings(params.atlas);
    settings.cull.across_seams = settings.carry_seams = params.carry_seams;
    settings.in_mm = true;
    settings.pre_scatter = params.pre_scatter;
    settings.specular = params.specular;
    settings.longest_texels = longest_step_texels(1 + params.atlas.kernel_growth, settings.size, frame);
    // Taps go to 3 sigma along each of two steps; a bilinear neighbour each, and one of the final mesh.
    double reach = 2;
    for (const Step& step : steps)
        reach += 2 * std::ceil(3.1 * step.sigma_mm * double(settings.longest_texels)) + 2;
    settings.cull.reach_texels = int(std::min(reach, double(settings.size)));
    return settings;
}

void add_gaussian(PassList& list, const Params& params, const AtlasLightSettings& atlas, const Step& step,
                  size_t index, size_t count) {
    const std::string name = "gaussian " + std::to_string(index + 1);
    const float part = 1 / float(count);
    // The light before the blur stays in light_map_a, for the final mesh.
    const std::string from = index == 0 ? "light_map_a" : "light_map_c";
    for (const bool second : {false, true}) {
        Pass pass = {.name = name + (second ? " second" : " first"),
                     .kind = PassKind::fullscreen,
                     .shader = std::string("texture_space_gaussians/gaussian_") +
                               (second ? "second" : "first") + ".frag",
                     .colors = {{.image = second ? "light_map_c" : "light_map_b", .load = LoadOp::discard}},
                     .constants = {{"along_second", int32_t(second)}, {"half_taps", params.half_taps}},
                     .values = {{"sigma_mm", float(step.sigma_mm)},
                                {"share", Vec4{step.share.x, step.share.y, step.share.z, part}}}};
        read_atlas_walk(pass, second ? "light_map_b" : from, atlas, kLongestTapSigmas * float(step.sigma_mm));
        keep_unculled(pass, atlas.cull);
        if (second)
            pass.colors.push_back({.image = "light_sum",
                                   .load = index == 0 ? LoadOp::clear : LoadOp::load,
                                   .blend = Blend::additive});
        list.passes.push_back(std::move(pass));
    }
}

PassList build(const ParameterValues& values, const FrameContext& frame) {
    const Params params = values.as<Params>();
    const std::vector<Step> steps =
        steps_of(frame.skin_gaussians, params.width, typical_texel_mm(params.atlas.light_map_size, frame));
    const AtlasLightSettings atlas = atlas_settings(params, steps, frame);
    const ImageSize size = {params.atlas.light_map_size, params.atlas.light_map_size};
    PassList list;
    // Not half floats: the rounding of a dozen passes in a row is visible.
    for (const char* name : {"light_map_a", "light_map_b"})
        list.images.push_back({.name = name, .format = ImageFormat::rgba32f, .size = size});
    if (!steps.empty())
        for (const char* name : {"light_map_c", "light_sum"})
            list.images.push_back({.name = name, .format = ImageFormat::rgba32f, .size = size});
    add_shadow_channels(list, atlas.shadow, frame);
    add_atlas_light(list, atlas, frame);
    for (size_t i = 0; i < steps.size(); ++i) add_gaussian(list, params, atlas, steps[i], i, steps.size());

    Pass skin = forward_skin_pass("texture_space_gaussians/final.frag", params.specular, frame, kOwnView);
    skin.reads = {{"light_map", steps.empty() ? "light_map_a" : "light_sum"},
                  {"light_map_lit", "light_map_a"}};
    skin.constants.emplace_back("detail", int32_t(params.atlas.detail));
    read_shadow_channels(skin, atlas.shadow, frame);
    read_transmission(skin, params.atlas.transmission, frame);
    list.passes.push_back(std::move(skin));
    return list;
}

// A smaller light map and the fewest taps; lengths are in mm and stay.
ParameterValues coarse(ParameterValues values, float scale) {
    constexpr int32_t kFewestTaps = 2;
    auto params = values.as<Params>();
    params.atlas = coarse_light_map(params.atlas, scale);
    params.half_taps = kFewestTaps;
    values.put_all(params);
    return values;
}

Result<std::vector<TableImage>> tables(const ParameterValues& values, const SkinContext& skin) {
    return transmission_tables(values.as<Params>().atlas.transmission, skin);
}

Result<std::vector<NamedValue>> skin_values(const ParameterValues& values, const SkinContext& skin) {
    const auto width = double(values.as<Params>().width);
    GaussianSum blur = skin.gaussians;
    for (GaussianTerm& term : blur.terms) term.variance_mm2 *= width * width;
    return detail_values([&](double texel_mm) { return kept_of_shortest_wave(blur, texel_mm); });
}

}  // namespace

Technique make_texture_space_gaussians_technique() {
    return {.id = "texture_space_gaussians",
            .summary = "diffuse light blurred over the surface by every Gaussian of the diffusion profile",
            .source = "d'Eon, Luebke 2007, Advanced Techniques for Realistic Real-Time Skin Rendering",
            .parameters = parameters(),
            .views = {kOwnView},
            .build = build,
            .tables = tables,
            .skin_values = skin_values,
            .coarse = coarse};
}

}  // namespace dermis
