// Gosselin, Sander, Mitchell 2004, "Real-Time Texture-Space Skin Rendering" (ShaderX3): light the skin in its
// texture atlas, blur that image with a kernel whose size is painted, and read it back through the camera.
// Four steps: shadow map (shared), light map, dilation and blur, final mesh. The source's blur knows
// only texels, so its width on the skin depends on the UV layout; with space=mm it is in millimetres.

#include <algorithm>
#include <cmath>
#include <utility>

#include "dermis/technique/atlas_light.h"
#include "dermis/technique/forward.h"
#include "techniques/texture_space/constants.h"
#include "techniques/texture_space/figures.h"

namespace dermis {
namespace {

enum class Filter : int32_t {
    poisson = kFilterPoisson,
    gaussian = kFilterGaussian,
    box = kFilterBox,
    kawase = kFilterKawase
};
enum class Dilate : int32_t { off = kDilateOff, source = kDilateSource, written_only = kDilateWrittenOnly };
enum class Space : int32_t { texels = kSpaceTexels, mm = kSpaceMm };
enum class Seams : int32_t { drop, carry };

constexpr const char* kOwnView = "light_map";
constexpr float kMaxBlurRadius = 64;

struct Params {
    AtlasParams atlas;
    Filter filter = Filter::poisson;
    int32_t blur_passes = 2;
    float blur_scale = 2;
    float blur_bias = 1;
    Dilate dilate = Dilate::written_only;
    Space space = Space::texels;
    Seams seams = Seams::carry;
    bool single_channel_opacity = false;
    bool second_light_shadow = false;
    ShadowLookup shadow_lookup = ShadowLookup::disk;
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
        .part(&Params::atlas, atlas_parameters())
        .choice(&Params::filter, "filter", {"poisson", "gaussian", "box", "kawase"},
                "pattern of the blur's taps")
        .integer(&Params::blur_passes, "blur_passes", "", 0, 16, "number of blurs of the light map")
        .number(&Params::blur_scale, "blur_scale", "texels or mm", 0, kMaxBlurRadius,
                "radius of the blur where the kernel map is 1")
        .number(&Params::blur_bias, "blur_bias", "texels or mm", 0, kMaxBlurRadius, "added to every radius")
        .choice(
            &Params::dilate, "dilate", {"off", "source", "written_only"},
            "at chart borders: nothing, the source's copy in the first pass, or average written texels only")
        .choice(&Params::space, "space", {"texels", "mm"},
                "unit of the blur's radius: texels, as in the source, or mm on the skin, independent of the "
                "UV layout")
        .choice(&Params::seams, "seams", {"drop", "carry"},
                "space=mm: taps that leave a chart are dropped, or get the light from across the seam")
        .toggle(&Params::single_channel_opacity, "single_channel_opacity",
                "translucent shadows without colour, from the red channel")
        .toggle(&Params::second_light_shadow, "second_light_shadow",
                "the second light casts a shadow too, from the channels that one light leaves free")
        .choice(&Params::shadow_lookup, "shadow_lookup", {"disk", "single"},
                "filtered over the penumbra, or the source's one texel with a bias of 0.01")
        .number(&Params::exempt_1_u, "exempt_1_u", "uv", 0, 1,
                "u of the centre of a region that is never culled, for example an ear")
        .number(&Params::exempt_1_v, "exempt_1_v", "uv", 0, 1, "the same")
        .number(&Params::exempt_1_radius, "exempt_1_radius", "uv", 0, 1, "its radius; 0: none")
        .number(&Params::exempt_2_u, "exempt_2_u", "uv", 0, 1, "u of the centre of a second such region")
        .number(&Params::exempt_2_v, "exempt_2_v", "uv", 0, 1, "the same")
        .number(&Params::exempt_2_radius, "exempt_2_radius", "uv", 0, 1, "its radius; 0: none")
        .toggle(&Params::cull_distance, "cull_distance",
                "keep the last light map while the camera is far away")
        .number(&Params::cull_beyond_mm, "cull_beyond_mm", "mm", 0, 1e6,
                "distance from which the camera is far away")
        .toggle(&Params::specular_shadow, "specular_shadow",
                "dim the key light's specular reflection by the blurred light")
        .number(&Params::specular_shadow_scale, "specular_shadow_scale", "", 0, 10,
                "factor on the blurred light, relative to the key light")
        .number(&Params::specular_shadow_bias, "specular_shadow_bias", "", -1, 1, "added after the factor")
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
    return int(std::min(reach, float(params.atlas.light_map_size)));
}

AtlasLightSettings atlas_settings(const Params& params, const FrameContext& frame, bool whole) {
    const bool carry = params.seams == Seams::carry;
    const float radius = params.blur_scale + params.blur_bias;
    AtlasLightSettings settings = atlas_light_settings(params.atlas);
    settings.in_mm = params.space == Space::mm;
    settings.shadow.second_light = params.second_light_shadow;
    settings.shadow.single_channel = params.single_channel_opacity;
    settings.shadow.lookup = params.shadow_lookup;
    if (whole) settings.cull.frustum = settings.cull.back_face = false;
    settings.cull.exempt[0] = {params.exempt_1_u, params.exempt_1_v, params.exempt_1_radius};
    settings.cull.exempt[1] = {params.exempt_2_u, params.exempt_2_v, params.exempt_2_radius};
    settings.longest_texels = longest_step_texels(radius, settings.size, frame);
    settings.cull.reach_texels = reach_texels(params, settings.in_mm ? settings.longest_texels : radius);
    settings.cull.across_seams = settings.in_mm && carry;
    settings.carry_seams = carry;
    settings.kernel_scale_mm = params.blur_scale;
    settings.kernel_bias_mm = params.blur_bias;
    return settings;
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

    const ImageSize size = {params.atlas.light_map_size, params.atlas.light_map_size};
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

    Pass skin = forward_skin_pass("texture_space/final.frag", params.specular, frame, kOwnView);
    skin.reads = {{"light_map", result}};
    skin.constants.insert(skin.constants.end(), {{"specular_shadow", int32_t(params.specular_shadow)},
                                                 {"space", int32_t(params.space)}});
    read_shadow_channels(skin, atlas.shadow, frame);
    list.passes.push_back(std::move(skin));
    return list;
}

// A smaller light map, and half of the blur's passes at a radius that widens the light as much: variances of
// blurs add, so that n passes of radius r and m of r sqrt(n / m) are one width. Kawase's filter has its radii
// from the number of the pass and keeps them.
ParameterValues coarse(ParameterValues values, float scale) {
    auto params = values.as<Params>();
    const AtlasParams whole = std::exchange(params.atlas, coarse_light_map(params.atlas, scale));
    float wider = params.space == Space::texels
                      ? float(params.atlas.light_map_size) / float(whole.light_map_size)
                      : 1.0f;
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
            .views = {kOwnView},
            .build = build,
            .coarse = coarse,
            .figures = texture_space_figures};
}

}  // namespace dermis
