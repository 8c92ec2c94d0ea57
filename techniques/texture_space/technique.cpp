// Gosselin, Sander, Mitchell 2004, "Real-Time Texture-Space Skin Rendering" (ShaderX3): light the skin in its
// texture atlas, blur that image with a kernel whose size is painted, and read it back through the camera.
// Four steps: shadow map (shared), light map, dilation and blur, final mesh. The source's filters know only
// texels, so that their width on the skin depends on the UV layout; blur=profile is in millimetres.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "dermis/technique/atlas_light.h"
#include "dermis/technique/forward.h"
#include "techniques/texture_space/blur_fit.h"
#include "techniques/texture_space/constants.h"
#include "techniques/texture_space/figures.h"

namespace dermis {
namespace {

using texture_space::BlurPass;

constexpr const char* kOwnView = "light_map";

enum class Blur : int32_t {
    profile,
    poisson = kFilterPoisson,
    gaussian = kFilterGaussian,
    box = kFilterBox,
    kawase = kFilterKawase
};
enum class Dilate : int32_t { off = kDilateOff, source = kDilateSource, written_only = kDilateWrittenOnly };
enum class SpecularShadow : int32_t {
    off = kSpecularShadowOff,
    source = kSpecularShadowSource,
    shadow_map = kSpecularShadowMap
};
// filtered: over the penumbra. The others read one texel, as the source does.
enum class Shadows : int32_t { filtered, source, one_channel, two_lights };

struct Params {
    AtlasParams atlas;
    float cull_beyond_mm = 0;
    Shadows shadows = Shadows::filtered;
    float trans_shadow_alpha = 1;
    float occluded = 0;
    Blur blur = Blur::profile;
    int32_t blur_passes = 4;
    float blur_radius = 2;
    Dilate dilate = Dilate::written_only;
    SpecularShadow specular_shadow = SpecularShadow::shadow_map;
    SpecularModel specular = SpecularModel::ggx;
};

constexpr float kMaxBlurRadius = 64;

ParameterTable parameters() {
    return ParameterTableBuilder<Params>()
        .part(&Params::atlas, atlas_parameters())
        .number(&Params::cull_beyond_mm, "cull_beyond_mm", "mm", 0, 1e6,
                "keep the last light map while the camera is farther away; 0: never")
        .choice(
            &Params::shadows, "shadows", {"filtered", "source", "one_channel", "two_lights"},
            "the key light's shadow: filtered over the penumbra; as the source has it: one texel, opacities "
            "added, N.L x colour saturated; the same with one channel of opacity; or with the second light's "
            "shadow in the channels that this leaves free")
        .number(&Params::trans_shadow_alpha, "trans_shadow_alpha", "", 0, 16,
                "exponent of a translucent shadow; larger is darker, 0 is none")
        .number(&Params::occluded, "occluded", "", 0, 1, "part of the key light that remains in full shadow")
        .choice(&Params::blur, "blur", {"profile", "poisson", "gaussian", "box", "kawase"},
                "profile: radii and colours from the skin's profile, in mm on the skin; or a filter of the "
                "source, in texels of the light map")
        .integer(&Params::blur_passes, "blur_passes", "", 0, 16,
                 "passes of the blur; with blur=profile at most so many")
        .number(&Params::blur_radius, "blur_radius", "texels", 0, kMaxBlurRadius,
                "a filter's radius where the kernel-size map is 0")
        .choice(&Params::dilate, "dilate", {"off", "source", "written_only"},
                "a filter at chart borders: nothing, the source's copy in the first pass, or the mean of "
                "written texels")
        .choice(&Params::specular_shadow, "specular_shadow", {"off", "source", "shadow_map"},
                "the key light's specular: not shadowed, dimmed by the blurred light's luminance as in the "
                "source, or shadowed as the diffuse light is")
        .choice(&Params::specular, "specular", specular_model_names(), "specular model")
        .preset("source", "the whole method of 2004",
                {.atlas = {.kernel_growth = 1.5f, .transmission = Transmission::none, .gain = Gain::none},
                 .shadows = Shadows::source,
                 .blur = Blur::poisson,
                 .dilate = Dilate::source,
                 .specular_shadow = SpecularShadow::source})
        .preset("cheap", "a coarser light map and fewer passes",
                {.atlas = {.light_map_size = 256}, .blur_passes = 2})
        .preset("best", "a finer light map", {.atlas = {.light_map_size = 1024}})
        .build();
}

std::string refusal(const ParameterValues& values) {
    const auto params = values.as<Params>();
    const bool profile = params.blur == Blur::profile;
    if ((profile || params.blur == Blur::kawase) && params.blur_radius != Params{}.blur_radius)
        return "blur=" + values.text(*values.table().find("blur")) +
               " has no blur_radius to set; drop blur_radius or set blur=poisson";
    if (profile && params.dilate != Params{}.dilate)
        return "blur=profile crosses chart borders and has nothing to dilate; drop dilate or set "
               "blur=poisson";
    return "";
}

// Radii are radius * (kernel map * kernel_growth + 1), in mm or texels.
struct BlurPlan {
    bool in_mm = true;
    std::vector<BlurPass> passes;
    float fitted_texel_mm = 0;  // for which passes were fitted; 0: in texels
};

// What a filter's taps without its centre weigh in the published filter, which includes the centre.
float taps_share(Blur blur) {
    switch (blur) {
        case Blur::poisson:
            return 12.0f / 13;
        case Blur::gaussian:
            return 12.0f / 16;
        case Blur::box:
            return 8.0f / 9;
        default:
            return 1;
    }
}

BlurPlan blur_plan(const Params& params, const FrameContext& frame) {
    if (params.blur == Blur::profile) {
        const double texel_mm = typical_texel_mm(light_map_side(params.atlas, frame), frame);
        return {.passes = texture_space::fit_blur(frame.skin_gaussians,
                                                  {.passes = params.blur_passes, .texel_mm = texel_mm}),
                .fitted_texel_mm = float(texel_mm)};
    }
    const float radius = params.blur == Blur::kawase ? 1 : params.blur_radius;
    const BlurPass pass = {.radius = radius, .share = Vec3{1, 1, 1} * taps_share(params.blur)};
    return {.in_mm = false, .passes = std::vector<BlurPass>(size_t(params.blur_passes), pass)};
}

// How far the passes after the light map carry light: the widest tap of every blur and its bilinear
// neighbour, and the bilinear lookups of the final mesh and of the light from across seams.
void set_reach(AtlasCullSettings& cull, const BlurPlan& plan, const Params& params) {
    cull.reach_texels = 2 + float(plan.passes.size());
    for (size_t i = 0; i < plan.passes.size(); ++i) {
        if (plan.in_mm)
            cull.reach_steps +=
                plan.passes[i].radius * std::numbers::sqrt2_v<float>;  // the corner of 3 x 3 taps
        else if (params.blur == Blur::kawase)
            cull.reach_texels += std::ceil(0.5f + float(i));
        else
            cull.reach_texels += std::ceil(plan.passes[i].radius * (params.atlas.kernel_growth + 1));
    }
}

AtlasLightSettings atlas_settings(const Params& params, const BlurPlan& plan, const FrameContext& frame,
                                  bool whole) {
    AtlasLightSettings settings = atlas_light_settings(params.atlas, frame);
    settings.in_mm = settings.cull.across_seams = plan.in_mm;
    settings.specular = params.specular;
    settings.shadow = {
        .translucent = params.trans_shadow_alpha > 0,
        .second_light = params.shadows == Shadows::two_lights,
        .single_channel = params.shadows == Shadows::one_channel,
        .lookup = params.shadows == Shadows::filtered ? ShadowLookup::disk : ShadowLookup::single};
    if (whole) settings.cull.frustum = settings.cull.back_face = false;
    settings.cull.keep_thin = !plan.in_mm;
    settings.longest_texels = longest_step_texels(1 + params.atlas.kernel_growth, settings.size, frame);
    set_reach(settings.cull, plan, params);
    return settings;
}

// The image that pass `index` reads and that the pass before it wrote. The first reads light_map_a; the
// others alternate between light_map_b and light_map_a, or light_map_c where light_map_a is kept.
std::string source_of(const BlurPlan& plan, size_t index) {
    if (index % 2 == 1) return "light_map_b";
    return plan.in_mm && index > 0 ? "light_map_c" : "light_map_a";
}

Pass blur_pass(const Params& params, const BlurPlan& plan, const AtlasLightSettings& atlas, size_t index) {
    const BlurPass& blur = plan.passes[index];
    const std::string from = source_of(plan, index);
    Pass pass = {.name = "blur " + std::to_string(index + 1),
                 .kind = PassKind::fullscreen,
                 .shader = plan.in_mm ? "texture_space/blur_mm.frag" : "texture_space/blur.frag",
                 .colors = {{.image = source_of(plan, index + 1), .load = LoadOp::discard}}};
    if (plan.in_mm) {
        // The corners of 3 x 3 taps are farthest.
        read_atlas_walk(pass, from, atlas, std::numbers::sqrt2_v<float> * blur.radius);
        pass.values = {
            {"radius", blur.radius}, {"share", blur.share}, {"fitted_texel_mm", plan.fitted_texel_mm}};
        return pass;
    }
    // The source dilates in the first pass only; written_only must hold in all.
    const Dilate dilate = params.dilate == Dilate::source && index > 0 ? Dilate::off : params.dilate;
    pass.reads = {{"source", from}};
    pass.colors[0].clear = {0, 0, 0, 1};  // alpha 1: not written
    pass.constants = {{"blur_filter", int32_t(params.blur)}, {"dilate", int32_t(dilate)}};
    const bool fixed = params.blur == Blur::kawase;
    pass.values = {{"kernel_scale", fixed ? 0.0f : blur.radius * params.atlas.kernel_growth},
                   {"kernel_bias", blur.radius},
                   {"pass_index", float(index)},
                   {"share", blur.share.x}};
    return pass;
}

int32_t texels_of(const Params& params, const BlurPlan& plan) {
    if (plan.in_mm) return kTexelsPremultiplied;
    return params.dilate == Dilate::written_only ? kTexelsWritten : kTexelsAsTheyAre;
}

PassList build(const ParameterValues& values, const FrameContext& frame) {
    const Params params = values.as<Params>();
    // Far away the light map of the frame before is used again. If that frame was far too, its map is
    // complete, because the first far frame draws all of it.
    const auto is_far = [&](float distance_mm) {
        return params.cull_beyond_mm > 0 && distance_mm > params.cull_beyond_mm;
    };
    const bool far = is_far(frame.camera_distance_mm);
    const bool kept = far && is_far(frame.previous_camera_distance_mm);

    const BlurPlan plan = blur_plan(params, frame);
    const int side = light_map_side(params.atlas, frame);
    const std::string result = source_of(plan, plan.passes.size());
    PassList list;
    for (const std::string name : {"light_map_a", "light_map_b", "light_map_c"}) {
        const bool read_later = name == result || (plan.in_mm && name == "light_map_a");
        const bool passed =
            name == "light_map_c" ? plan.in_mm && plan.passes.size() > 1 : !plan.passes.empty() || plan.in_mm;
        if (!read_later && (kept || !passed)) continue;
        list.images.push_back({.name = name,
                               .format = ImageFormat::rgba16f,
                               .size = {side, side},
                               .persistent = params.cull_beyond_mm > 0 && read_later});
    }
    const AtlasLightSettings atlas = atlas_settings(params, plan, frame, far);
    add_shadow_channels(list, atlas.shadow, frame);
    if (!kept) {
        add_atlas_light(list, atlas, frame);
        for (size_t i = 0; i < plan.passes.size(); ++i) {
            list.passes.push_back(blur_pass(params, plan, atlas, i));
            keep_unculled(list.passes.back(), atlas.cull);
        }
    }

    Pass skin = forward_skin_pass("texture_space/final.frag", params.specular, frame, kOwnView);
    skin.reads = {{"light_map", result}, {"light_map_lit", plan.in_mm ? "light_map_a" : result}};
    skin.constants.insert(skin.constants.end(), {{"specular_shadow", int32_t(params.specular_shadow)},
                                                 {"light_map_texels", texels_of(params, plan)},
                                                 {"detail", plan.in_mm ? kDetailPixel : kDetailMap}});
    read_shadow_channels(skin, atlas.shadow, frame);
    read_transmission(skin, params.atlas.transmission, frame);
    use_gain(skin, params.atlas.gain);
    list.passes.push_back(std::move(skin));
    return list;
}

// A smaller light map, and fewer of the blur's passes at a width that is the same. Variances of blurs add, so
// that n passes of radius r are as wide as m of radius r sqrt(n / m). A fit to the profile finds its own
// radii for the fewer passes; Kawase's radii follow from the number of the pass and are kept.
ParameterValues coarse(ParameterValues values, float scale) {
    auto params = values.as<Params>();
    const auto fine_size = float(params.atlas.light_map_size);
    params.atlas = coarse_light_map(params.atlas, scale);
    const int32_t passes = params.blur_passes;
    if (params.blur == Blur::profile)
        params.blur_passes = (3 * passes + 3) / 4;  // half of them are rings of taps that show
    else if (params.blur != Blur::kawase && passes > 0) {
        params.blur_passes = (passes + 1) / 2;
        const float wider = std::sqrt(float(passes) / float(params.blur_passes));
        params.blur_radius = std::min(
            params.blur_radius * wider * float(params.atlas.light_map_size) / fine_size, kMaxBlurRadius);
    }
    values.put_all(params);
    return values;
}

Result<std::vector<TableImage>> tables(const ParameterValues& values, const SkinContext& skin) {
    return transmission_tables(values.as<Params>().atlas.transmission, skin);
}

// Without passes nothing is blurred, and all detail is kept.
Result<std::vector<NamedValue>> skin_values(const ParameterValues& values, const SkinContext& skin) {
    const Params params = values.as<Params>();
    return atlas_skin_values(
        [&](double texel_mm) {
            return params.blur_passes == 0 ? Vec3{1, 1, 1} : kept_of_half_held_wave(skin.gaussians, texel_mm);
        },
        {.occluded = params.occluded, .trans_shadow_alpha = params.trans_shadow_alpha});
}

}  // namespace

Technique make_texture_space_technique() {
    return {.id = "texture_space",
            .summary = "diffuse light blurred in the skin's texture atlas",
            .source = "Gosselin, Sander, Mitchell 2004, Real-Time Texture-Space Skin Rendering",
            .parameters = parameters(),
            .views = {kOwnView},
            .refusal = refusal,
            .build = build,
            .tables = tables,
            .skin_values = skin_values,
            .coarse = coarse,
            .figures = texture_space_figures};
}

}  // namespace dermis
