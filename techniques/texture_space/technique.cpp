// Gosselin, Sander, Mitchell 2004, "Real-Time Texture-Space Skin Rendering" (ShaderX3): light the skin in its
// texture atlas, blur that image with a kernel whose size is painted, and read it back through the camera.
// Four steps: shadow map (shared), light map, dilation and blur, final mesh. The source's blur knows
// texels, so its width on the skin follows the unwrap; with space=mm it knows the surface.

#include <algorithm>
#include <cmath>

#include "dermis/technique/atlas_light.h"
#include "dermis/technique/forward.h"
#include "techniques/texture_space/figures.h"

namespace dermis {
namespace {

enum class Filter : int32_t { poisson, gaussian, box, kawase };
enum class Dilate : int32_t { off, source, written_only };
enum class Space : int32_t { texels, mm };
enum class Seams : int32_t { drop, carry };

constexpr float kMaxBlurRadius = 64;

struct Params {
    int32_t light_map_size = 1024;
    Filter filter = Filter::poisson;
    int32_t blur_passes = 2;
    float blur_scale = 2;
    float blur_bias = 1;
    Dilate dilate = Dilate::written_only;
    Space space = Space::texels;
    Seams seams = Seams::carry;
    bool translucent_shadows = true;
    float occluded = 0;
    float trans_shadow_alpha = 1;
    bool single_channel_opacity = false;
    bool second_light_shadow = false;
    ShadowLookup shadow_lookup = ShadowLookup::disk;
    bool cull_frustum = true;
    bool cull_back_face = true;
    float cull_bias = 0.3f;
    float exempt_1_u = 0, exempt_1_v = 0, exempt_1_radius = 0;
    float exempt_2_u = 0, exempt_2_v = 0, exempt_2_radius = 0;
    bool cull_distance = false;
    float cull_beyond_mm = 3000;
    bool specular_shadow = true;
    float specular_shadow_scale = 1.5f;
    float specular_shadow_bias = 0;
    SpecularModel specular = SpecularModel::ggx;
};

ParameterTable parameters() {
    return ParameterTableBuilder<Params>()
        .integer(&Params::light_map_size, "light_map_size", "texels", 16, 4096, "side of the light map")
        .choice(&Params::filter, "filter", {"poisson", "gaussian", "box", "kawase"}, "taps of the blur")
        .integer(&Params::blur_passes, "blur_passes", "", 0, 16, "how often the light map is blurred")
        .number(&Params::blur_scale, "blur_scale", "texels or mm", 0, kMaxBlurRadius,
                "radius of the blur where the kernel map is 1")
        .number(&Params::blur_bias, "blur_bias", "texels or mm", 0, kMaxBlurRadius, "added to every radius")
        .choice(
            &Params::dilate, "dilate", {"off", "source", "written_only"},
            "at chart borders: nothing, the source's copy in the first pass, or average written texels only")
        .choice(&Params::space, "space", {"texels", "mm"},
                "the blur's radius is in texels, as in the source, or in mm on the skin, whatever the unwrap")
        .choice(&Params::seams, "seams", {"drop", "carry"},
                "in mm: taps that leave a chart are dropped, or carried into the chart beyond the seam")
        .toggle(&Params::translucent_shadows, "translucent_shadows", "translucent objects tint the key light")
        .number(&Params::occluded, "occluded", "", 0, 1, "share of the light that full shadow leaves")
        .number(&Params::trans_shadow_alpha, "trans_shadow_alpha", "", 0, 16,
                "exponent of a translucent shadow; larger is darker")
        .toggle(&Params::single_channel_opacity, "single_channel_opacity",
                "translucent shadows without colour, from the red channel")
        .toggle(&Params::second_light_shadow, "second_light_shadow",
                "the second light casts a shadow too, from the channels that one light leaves free")
        .choice(&Params::shadow_lookup, "shadow_lookup", {"disk", "single"},
                "filtered over the penumbra, or the source's one texel with a bias of 0.01")
        .toggle(&Params::cull_frustum, "cull_frustum", "leave out texels outside the view")
        .toggle(&Params::cull_back_face, "cull_back_face", "leave out texels that face away")
        .number(&Params::cull_bias, "cull_bias", "", 0, 2, "added to the cosine between view and normal")
        .number(&Params::exempt_1_u, "exempt_1_u", "uv", 0, 1, "an ear that is never culled: middle")
        .number(&Params::exempt_1_v, "exempt_1_v", "uv", 0, 1, "the same")
        .number(&Params::exempt_1_radius, "exempt_1_radius", "uv", 0, 1, "its radius; 0: none")
        .number(&Params::exempt_2_u, "exempt_2_u", "uv", 0, 1, "the other ear: middle")
        .number(&Params::exempt_2_v, "exempt_2_v", "uv", 0, 1, "the same")
        .number(&Params::exempt_2_radius, "exempt_2_radius", "uv", 0, 1, "its radius; 0: none")
        .toggle(&Params::cull_distance, "cull_distance", "keep the last light map while the camera is far")
        .number(&Params::cull_beyond_mm, "cull_beyond_mm", "mm", 0, 1e6, "how far that is")
        .toggle(&Params::specular_shadow, "specular_shadow",
                "dim the key light's specular by the blurred light")
        .number(&Params::specular_shadow_scale, "specular_shadow_scale", "", 0, 10, "times the light's share")
        .number(&Params::specular_shadow_bias, "specular_shadow_bias", "", -1, 1, "added to it")
        .choice(&Params::specular, "specular", specular_model_names(), "specular model")
        .build();
}

// Kawase's taps move out from pass to pass (taps.glsl).
float widest_tap(const Params& params, int pass) {
    return params.filter == Filter::kawase ? 0.5f + 0.5f * float(pass) : 1.0f;
}

// How far the passes after the light map carry it: the widest tap of every blur and its bilinear neighbour,
// and the bilinear lookup of the final mesh. In mm a tap goes along two steps at once.
int reach_texels(const Params& params, float radius_texels) {
    float reach = 1;
    for (int i = 0; i < params.blur_passes; ++i)
        reach +=
            std::ceil(widest_tap(params, i) * radius_texels * (params.space == Space::mm ? 2.0f : 1.0f)) + 1;
    return int(std::min(reach, float(params.light_map_size)));
}

AtlasLightSettings atlas_settings(const Params& params, const FrameContext& frame, bool whole) {
    const bool in_mm = params.space == Space::mm, carry = params.seams == Seams::carry;
    const float radius = params.blur_scale + params.blur_bias;
    const float longest = longest_step_texels(radius, params.light_map_size, frame);
    return {.shadow = {.translucent = params.translucent_shadows,
                       .second_light = params.second_light_shadow,
                       .single_channel = params.single_channel_opacity,
                       .lookup = params.shadow_lookup},
            .cull = {.frustum = params.cull_frustum && !whole,
                     .back_face = params.cull_back_face && !whole,
                     .bias = params.cull_bias,
                     .exempt = {{params.exempt_1_u, params.exempt_1_v, params.exempt_1_radius},
                                {params.exempt_2_u, params.exempt_2_v, params.exempt_2_radius}},
                     .reach_texels = reach_texels(params, in_mm ? longest : radius),
                     .size = params.light_map_size,
                     .across_seams = in_mm && carry},
            .size = params.light_map_size,
            .in_mm = in_mm,
            .carry_seams = carry,
            .kernel_scale_mm = params.blur_scale,
            .kernel_bias_mm = params.blur_bias,
            .longest_texels = longest};
}

constexpr std::array<float, 4> kNothingWritten = {0, 0, 0, 1};

Pass blur_pass(const Params& params, int index) {
    const bool to_b = index % 2 == 0;
    // The source dilates in the first pass only; counting written texels only must hold in all.
    const Dilate dilate = params.dilate == Dilate::source && index > 0 ? Dilate::off : params.dilate;
    return {.name = "blur " + std::to_string(index + 1),
            .kind = PassKind::fullscreen,
            .shader = "texture_space/blur.frag",
            .reads = {{"source", to_b ? "light_map_a" : "light_map_b"}},
            .colors = {{.image = to_b ? "light_map_b" : "light_map_a",
                        .load = LoadOp::discard,
                        .clear = kNothingWritten}},
            .constants = {{"blur_filter", int32_t(params.filter)}, {"dilate", int32_t(dilate)}},
            .values = {{"pass_index", float(index)}}};
}

Pass blur_mm_pass(const Params& params, const AtlasLightSettings& atlas, int index) {
    Pass pass = blur_pass(params, index);
    const std::string from = pass.reads[0].image;
    pass.shader = "texture_space/blur_mm.frag";
    pass.reads.clear();
    pass.constants = {{"blur_filter", int32_t(params.filter)}};
    pass.colors[0].clear = {0, 0, 0, 0};
    read_atlas_metric(pass, from, atlas);
    return pass;
}

// Culls, light map and blur.
void add_light_map(PassList& list, const Params& params, const AtlasLightSettings& atlas,
                   const FrameContext& frame) {
    add_atlas_light(list, atlas, frame);
    for (int i = 0; i < params.blur_passes; ++i) {
        list.passes.push_back(atlas.in_mm ? blur_mm_pass(params, atlas, i) : blur_pass(params, i));
        keep_unculled(list.passes.back(), atlas.cull);
    }
}

PassList build(const ParameterValues& values, const FrameContext& frame) {
    const Params params = values.as<Params>();
    // Far away the map of the frame before is taken again: if that one was far too, it is whole, for the
    // first far frame draws all of it.
    const auto is_far = [&](float distance_mm) {
        return params.cull_distance && distance_mm > params.cull_beyond_mm;
    };
    const bool far = is_far(frame.camera_distance_mm);
    const bool kept = far && is_far(frame.previous_camera_distance_mm);

    const ImageSize size = {params.light_map_size, params.light_map_size};
    const std::string result = params.blur_passes % 2 == 0 ? "light_map_a" : "light_map_b";
    // In mm charts and gutters must agree to a thousandth, which halves lose in a few passes.
    const ImageFormat format = params.space == Space::mm ? ImageFormat::rgba32f : ImageFormat::rgba16f;
    PassList list;
    for (const char* name : {"light_map_a", "light_map_b"})
        if (name == result || ((params.blur_passes > 0 || params.space == Space::mm) && !kept))
            list.images.push_back({.name = name,
                                   .format = format,
                                   .size = size,
                                   .persistent = params.cull_distance && name == result});
    const AtlasLightSettings atlas = atlas_settings(params, frame, far);
    add_shadow_channels(list, atlas.shadow, frame);
    if (!kept) add_light_map(list, params, atlas, frame);

    const int32_t view = frame.view == "light_map" ? 3 : forward_view(frame.view);
    Pass skin = {.name = "skin",
                 .kind = PassKind::geometry_screen,
                 .shader = "texture_space/final.frag",
                 .reads = {{"light_map", result}},
                 .colors = {{.image = "radiance", .load = LoadOp::load}},
                 .depth = DepthTarget{.image = "depth", .load = LoadOp::load},
                 .geometry = GeometryFilter::skin,
                 .constants = {{"specular_model", int32_t(params.specular)},
                               {"view", view},
                               {"specular_shadow", int32_t(params.specular_shadow)},
                               {"space", int32_t(params.space)}}};
    read_shadow_channels(skin, atlas.shadow, frame);
    list.passes.push_back(std::move(skin));
    return list;
}

// A smaller light map, and half of the blur's passes at a radius that widens the light as much: variances of
// blurs add, so that n passes of radius r and m of r sqrt(n / m) are one width. Kawase's filter has its radii
// from the number of the pass and keeps them.
ParameterValues coarse(ParameterValues values, float scale) {
    constexpr int32_t kSmallest = 256;
    auto params = values.as<Params>();
    const int32_t size =
        std::max(int32_t(float(params.light_map_size) * scale), std::min(params.light_map_size, kSmallest));
    float wider = params.space == Space::texels ? float(size) / float(params.light_map_size) : 1.0f;
    params.light_map_size = size;
    if (params.filter != Filter::kawase && params.blur_passes > 1) {
        const int32_t passes = (params.blur_passes + 1) / 2;
        wider *= std::sqrt(float(params.blur_passes) / float(passes));
        params.blur_passes = passes;
    }
    params.blur_scale = std::min(params.blur_scale * wider, kMaxBlurRadius);
    params.blur_bias = std::min(params.blur_bias * wider, kMaxBlurRadius);
    values.put_all(params);
    return values;
}

}  // namespace

Technique make_texture_space_technique() {
    return {.id = "texture_space",
            .summary = "diffuse light blurred in the texture atlas, by a painted kernel size",
            .source = "Gosselin, Sander, Mitchell 2004, Real-Time Texture-Space Skin Rendering",
            .parameters = parameters(),
            .views = {"light_map"},
            .build = build,
            .coarse = coarse,
            .figures = texture_space_figures};
}

}  // namespace dermis
