// d'Eon, Luebke 2007, "Advanced Techniques for Realistic Real-Time Skin Rendering" (GPU Gems 3, chapter 14):
// the light map is blurred by each Gaussian of the diffusion profile, each from the one before, in two
// passes along the surface, and the results are summed by the profile's weights. Changed: the steps of the
// blur follow shear as well as stretch and agree across seams (shaders/atlas/blur_mm.glsl); gutter texels
// hold the light from across the UV seam; the Gaussians are those that the texels can tell apart
// (shared_gaussians.h); the sum is accumulated, so that any number of Gaussians needs five images; what is
// too small for the texels is lit at the pixel (detail=pixel); transmission is summed from the shadow map
// itself. The energy that the specular takes is an option of the scene.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/technique/atlas_light.h"
#include "dermis/technique/forward.h"
#include "techniques/texture_space_gaussians/gain_spread.h"
#include "techniques/texture_space_gaussians/shared_gaussians.h"

namespace dermis {
namespace {

constexpr const char* kOwnView = "light_map";

enum class Gaussians : int32_t { fitted, profile };
enum class Detail : int32_t { map = kDetailMap, pixel = kDetailPixel };

struct Params {
    AtlasParams atlas;
    Detail detail = Detail::pixel;
    float width = 1;
    Gaussians gaussians = Gaussians::fitted;
    int32_t half_taps = 3;
    bool carry_seams = true;
    float pre_scatter = 0;
    SpecularModel specular = SpecularModel::ggx;
};

ParameterTable parameters() {
    return ParameterTableBuilder<Params>()
        .part(&Params::atlas, atlas_parameters())
        .choice(&Params::detail, "detail", {"map", "pixel"},
                "what is too small for the light map's texels is lost, as in the source, or lit at the pixel")
        .number(&Params::width, "width", "", 0, 10, "scales the profile's lengths")
        .choice(&Params::gaussians, "gaussians", {"fitted", "profile"},
                "as few as the texels can tell apart, or every one of the profile, as in the source")
        .integer(&Params::half_taps, "half_taps", "", 2, 12, "taps on each side of a Gaussian's centre")
        .toggle(&Params::carry_seams, "carry_seams",
                "blur across the atlas's seams; off: taps that leave a chart are dropped")
        .number(&Params::pre_scatter, "pre_scatter", "", 0, 1,
                "exponent of the base colour before the blur; the rest is applied after it")
        .choice(&Params::specular, "specular", specular_model_names(), "specular model")
        .preset("source", "every Gaussian of the profile, half of the base colour before the blur",
                {.atlas = {.transmission = Transmission::none, .gain = Gain::none},
                 .detail = Detail::map,
                 .gaussians = Gaussians::profile,
                 .carry_seams = false,
                 .pre_scatter = 0.5f})
        .preset("best", "the light of walks from vertex to vertex: a minute of walks, then cached",
                {.atlas = {.gain = Gain::links}})
        .preset("cheap", "a coarser light map and fewer taps",
                {.atlas = {.light_map_size = 256}, .half_taps = 2})
        .build();
}

// From a tap to the next (spacing() in gaussian.glsl), in sigmas, with the fewest taps.
constexpr float kLongestTapSigmas = 1.6f;

// One step of the blur: from the variance before to this one, and its share of the profile.
struct Step {
    double variance_mm2 = 0, sigma_mm = 0;
    Vec3 share;
};

// The profile's terms, narrowest first, equal variances together; shares sum to 1 per channel, as albedo lies
// in the base colour.
std::vector<Step> steps_of(std::vector<GaussianTerm> terms) {
    std::ranges::sort(terms, {}, &GaussianTerm::variance_mm2);
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
                         .sigma_mm = std::sqrt(term.variance_mm2 - before_mm2),
                         .share = own});
        before_mm2 = term.variance_mm2;
    }
    return steps;
}

GaussianSum widened(GaussianSum sum, float width) {
    for (GaussianTerm& term : sum.terms) term.variance_mm2 *= double(width) * double(width);
    return sum;
}

struct Blur {
    std::vector<Step> steps;
    Vec3 unblurred = {0, 0, 0};             // share of the light before the blur
    Vec3 widest_share_of_gain = {0, 0, 0};  // of the light that gain - 1 multiplies: what the last step gives
};

Blur blur_of(const Params& params, const FrameContext& frame) {
    const GaussianSum profile = widened(frame.skin_gaussians, params.width);
    GaussianSum sum = profile;
    if (params.gaussians == Gaussians::fitted)
        sum = texture_space_gaussians::shared_gaussians(
            sum, typical_texel_mm(light_map_side(params.atlas, frame), frame));
    Blur blur = {.steps = steps_of(std::move(sum.terms))};
    if (!blur.steps.empty() && blur.steps[0].sigma_mm <= 0) {
        blur.unblurred = blur.steps[0].share;
        blur.steps.erase(blur.steps.begin());
    }
    if (!blur.steps.empty())
        blur.widest_share_of_gain =
            texture_space_gaussians::widest_share_of_gain(profile, blur.steps.back().variance_mm2);
    return blur;
}

AtlasLightSettings atlas_settings(const Params& params, const std::vector<Step>& steps,
                                  const FrameContext& frame) {
    AtlasLightSettings settings = atlas_light_settings(params.atlas, frame);
    settings.cull.across_seams = settings.carry_seams = params.carry_seams;
    settings.in_mm = true;
    settings.pre_scatter = params.pre_scatter;
    settings.specular = params.specular;
    settings.longest_texels = longest_step_texels(1 + params.atlas.kernel_growth, settings.size, frame);
    // Taps go to 3 sigma along each of two directions at right angles; a bilinear neighbour each, and one of
    // the final mesh and of the light from across seams.
    settings.cull.reach_texels = 2 + 2 * float(steps.size());
    for (const Step& step : steps)
        settings.cull.reach_steps += std::numbers::sqrt2_v<float> * 3.1f * float(step.sigma_mm);
    return settings;
}

Vec4 in_sum(const Vec3& share, float part) {
    return {share.x, share.y, share.z, part};
}

// Two images in turn, so that the last sum is in light_sum.
std::string sum_after(const Blur& blur, size_t index) {
    return (blur.steps.size() - index) % 2 == 1 ? "light_sum" : "light_sum_before";
}

void add_gaussian(PassList& list, const Params& params, const AtlasLightSettings& atlas, const Blur& blur,
                  size_t index) {
    const Step& step = blur.steps[index];
    const std::string name = "gaussian " + std::to_string(index + 1);
    const float part = 1 / float(blur.steps.size());
    // The light before the blur stays in light_map_a, for the sum and the final mesh.
    const std::string from = index == 0 ? "light_map_a" : "light_map_c";
    for (const bool second : {false, true}) {
        Pass pass = {.name = name + (second ? " second" : " first"),
                     .kind = PassKind::fullscreen,
                     .shader = std::string("texture_space_gaussians/gaussian_") +
                               (second ? "second" : "first") + ".frag",
                     .colors = {{.image = second ? "light_map_c" : "light_map_b", .load = LoadOp::discard}},
                     .constants = {{"along_second", int32_t(second)}, {"half_taps", params.half_taps}},
                     .values = {{"sigma_mm", float(step.sigma_mm)}}};
        read_atlas_walk(pass, second ? "light_map_b" : from, atlas, kLongestTapSigmas * float(step.sigma_mm));
        keep_unculled(pass, atlas.cull);
        if (second) {
            pass.reads.emplace_back("sum_before", index == 0 ? "light_map_a" : sum_after(blur, index - 1));
            pass.colors.push_back({.image = sum_after(blur, index), .load = LoadOp::discard});
            pass.values.emplace_back("share", in_sum(step.share, part));
            pass.values.emplace_back("share_before",
                                     index == 0 ? in_sum(blur.unblurred, 0) : Vec4{1, 1, 1, 1});
        }
        list.passes.push_back(std::move(pass));
    }
}

PassList build(const ParameterValues& values, const FrameContext& frame) {
    const Params params = values.as<Params>();
    const Blur blur = blur_of(params, frame);
    const AtlasLightSettings atlas = atlas_settings(params, blur.steps, frame);
    const int side = light_map_side(params.atlas, frame);
    const ImageSize size = {side, side};
    PassList list;
    for (const char* name : {"light_map_a", "light_map_b"})
        list.images.push_back({.name = name, .format = ImageFormat::rgba16f, .size = size});
    if (!blur.steps.empty())
        for (const char* name : {"light_map_c", "light_sum", "light_sum_before"})
            list.images.push_back({.name = name, .format = ImageFormat::rgba16f, .size = size});
    add_shadow_channels(list, atlas.shadow, frame);
    add_atlas_light(list, atlas, frame);
    for (size_t i = 0; i < blur.steps.size(); ++i) add_gaussian(list, params, atlas, blur, i);

    Pass skin = forward_skin_pass("texture_space_gaussians/final.frag", params.specular, frame, kOwnView);
    skin.reads = {{"light_map", blur.steps.empty() ? "light_map_a" : "light_sum"},
                  {"light_map_lit", "light_map_a"},
                  {"light_map_widest", blur.steps.empty() ? "light_map_a" : "light_map_c"}};
    skin.values = {{"widest_share_of_gain", blur.widest_share_of_gain}, {"pre_scatter", params.pre_scatter}};
    skin.constants.emplace_back("detail", int32_t(params.detail));
    read_shadow_channels(skin, atlas.shadow, frame);
    read_transmission(skin, params.atlas.transmission, frame);
    use_gain(skin, params.atlas.gain);
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
    const GaussianSum blur = widened(skin.gaussians, values.as<Params>().width);
    return atlas_skin_values([&](double texel_mm) { return kept_of_half_held_wave(blur, texel_mm); });
}

}  // namespace

Technique make_texture_space_gaussians_technique() {
    return {.id = "texture_space_gaussians",
            .summary = "diffuse light blurred by each Gaussian of the profile",
            .source = "d'Eon, Luebke 2007, Advanced Techniques for Realistic Real-Time Skin Rendering",
            .is_default = true,
            .parameters = parameters(),
            .views = {kOwnView},
            .build = build,
            .tables = tables,
            .skin_values = skin_values,
            .coarse = coarse};
}

}  // namespace dermis
