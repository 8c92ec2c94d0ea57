// Gosselin, Sander, Mitchell 2004, "Real-Time Texture-Space Skin Rendering" (ShaderX3): light the skin in its
// texture atlas, blur that image with a kernel whose size is painted, and read it back through the camera.
// Four steps: shadow map (shared), light map, dilation and blur, final mesh. The blur knows texels, not
// millimetres: its width on the skin follows the unwrap. Not here: the three culls in texture space, blur in
// millimetres.

#include "dermis/technique/forward.h"
#include "dermis/technique/shadow_channels.h"

namespace dermis {
namespace {

enum class Filter : int32_t { poisson, gaussian, box, kawase };
enum class Dilate : int32_t { off, source, written_only };

struct Params {
    int32_t light_map_size = 1024;
    Filter filter = Filter::poisson;
    int32_t blur_passes = 2;
    float blur_scale = 2;
    float blur_bias = 1;
    Dilate dilate = Dilate::written_only;
    bool translucent_shadows = true;
    float occluded = 0;
    float trans_shadow_alpha = 1;
    bool single_channel_opacity = false;
    bool second_light_shadow = false;
    ShadowLookup shadow_lookup = ShadowLookup::disk;
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
        .number(&Params::blur_scale, "blur_scale", "texels", 0, 64,
                "radius of the blur where the kernel map is 1")
        .number(&Params::blur_bias, "blur_bias", "texels", 0, 64, "added to every radius")
        .choice(
            &Params::dilate, "dilate", {"off", "source", "written_only"},
            "at chart borders: nothing, the source's copy in the first pass, or average written texels only")
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
        .toggle(&Params::specular_shadow, "specular_shadow",
                "dim the key light's specular by the blurred light")
        .number(&Params::specular_shadow_scale, "specular_shadow_scale", "", 0, 10, "times the light's share")
        .number(&Params::specular_shadow_bias, "specular_shadow_bias", "", -1, 1, "added to it")
        .choice(&Params::specular, "specular", specular_model_names(), "specular model")
        .build();
}

Pass blur_pass(const Params& params, int index) {
    const bool to_b = index % 2 == 0;
    // The source dilates in the first pass only; counting written texels only must hold in all.
    const Dilate dilate = params.dilate == Dilate::source && index > 0 ? Dilate::off : params.dilate;
    return {.name = "blur " + std::to_string(index + 1),
            .kind = PassKind::fullscreen,
            .shader = "texture_space/blur.frag",
            .reads = {{"source", to_b ? "light_map_a" : "light_map_b"}},
            .colors = {{.image = to_b ? "light_map_b" : "light_map_a", .load = LoadOp::discard}},
            .constants = {{"blur_filter", int32_t(params.filter)}, {"dilate", int32_t(dilate)}},
            .values = {{"pass_index", float(index)}}};
}

PassList build(const ParameterValues& values, const FrameContext& frame) {
    const Params params = values.as<Params>();
    const ImageSize size = {params.light_map_size, params.light_map_size};
    PassList list = {.images = {{.name = "light_map_a", .format = ImageFormat::rgba16f, .size = size}}};
    const ShadowChannelSettings shadow = {.translucent = params.translucent_shadows,
                                          .second_light = params.second_light_shadow,
                                          .single_channel = params.single_channel_opacity,
                                          .lookup = params.shadow_lookup};
    add_shadow_channels(list, shadow, frame);
    Pass light = {.name = "light map",
                  .kind = PassKind::geometry_uv_atlas,
                  .shader = "shared/atlas_light.frag",
                  .colors = {{.image = "light_map_a", .clear = {0, 0, 0, 1}}}};
    read_shadow_channels(light, shadow, frame);
    list.passes.push_back(std::move(light));
    if (params.blur_passes > 0)
        list.images.push_back({.name = "light_map_b", .format = ImageFormat::rgba16f, .size = size});
    for (int i = 0; i < params.blur_passes; ++i) list.passes.push_back(blur_pass(params, i));

    const int32_t view = frame.view == "light_map" ? 3 : forward_view(frame.view);
    list.passes.push_back(
        {.name = "skin",
         .kind = PassKind::geometry_screen,
         .shader = "texture_space/final.frag",
         .reads = {{"light_map", params.blur_passes % 2 == 0 ? "light_map_a" : "light_map_b"}},
         .colors = {{.image = "radiance", .load = LoadOp::load}},
         .depth = DepthTarget{.image = "depth", .load = LoadOp::load},
         .geometry = GeometryFilter::skin,
         .constants = {{"specular_model", int32_t(params.specular)},
                       {"view", view},
                       {"specular_shadow", int32_t(params.specular_shadow)}}});
    return list;
}

}  // namespace

Technique make_texture_space_technique() {
    return {.id = "texture_space",
            .summary = "diffuse light blurred in the texture atlas, by a painted kernel size",
            .source = "Gosselin, Sander, Mitchell 2004, Real-Time Texture-Space Skin Rendering",
            .parameters = parameters(),
            .views = {"light_map"},
            .build = build};
}

}  // namespace dermis
