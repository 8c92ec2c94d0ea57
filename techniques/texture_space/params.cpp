#include "techniques/texture_space/params.h"

namespace dermis::texture_space {

ParameterTable parameter_table() {
    return ParameterTableBuilder<Params>()
        .part(&Params::atlas, atlas_parameters())
        .choice(&Params::blur, "blur", {"profile", "source", "set"},
                "radii of the blur: from the skin's profile and the texels' size on it, for each colour; the "
                "source's (3, 2) texels of poisson on a light map of 512; or blur_scale and blur_bias")
        .choice(&Params::filter, "filter", {"poisson", "gaussian", "box", "kawase"},
                "taps of the blur; kawase's are in texels and equally wide in all colours")
        .integer(&Params::blur_passes, "blur_passes", "", 0, 16,
                 "number of passes of the blur; with blur=profile their maximum")
        .number(&Params::blur_scale, "blur_scale", "texels or mm", 0, kMaxBlurRadius,
                "blur=set: added to the radius where the kernel map is 1")
        .number(&Params::blur_bias, "blur_bias", "texels or mm", 0, kMaxBlurRadius,
                "blur=set: the radius where the kernel map is 0")
        .choice(&Params::dilate, "dilate", {"off", "source", "written_only"},
                "in texels, at chart borders: nothing, the source's copy in the first pass, or written "
                "texels only")
        .choice(&Params::space, "space", {"texels", "mm"},
                "radii in texels, as in the source, or in mm on the skin, independent of the UV layout")
        .choice(&Params::seams, "seams", {"drop", "carry"},
                "in mm: taps that leave a chart are dropped, or read in the chart across the seam")
        .toggle(&Params::single_channel_opacity, "single_channel_opacity",
                "translucent shadows without colour, from the red channel")
        .toggle(&Params::second_light_shadow, "second_light_shadow",
                "the second light casts a shadow too, from the channels that one light leaves free")
        .choice(&Params::shadow_lookup, "shadow_lookup", {"disk", "single"},
                "filtered over the penumbra, or the source's one texel with a bias of 0.01")
        .number(&Params::exempt_1_u, "exempt_1_u", "uv", 0, 1, "an ear that is never culled: middle")
        .number(&Params::exempt_1_v, "exempt_1_v", "uv", 0, 1, "the same")
        .number(&Params::exempt_1_radius, "exempt_1_radius", "uv", 0, 1, "its radius; 0: none")
        .number(&Params::exempt_2_u, "exempt_2_u", "uv", 0, 1, "the other ear: middle")
        .number(&Params::exempt_2_v, "exempt_2_v", "uv", 0, 1, "the same")
        .number(&Params::exempt_2_radius, "exempt_2_radius", "uv", 0, 1, "its radius; 0: none")
        .toggle(&Params::cull_distance, "cull_distance", "keep the last light map while the camera is far")
        .number(&Params::cull_beyond_mm, "cull_beyond_mm", "mm", 0, 1e6, "how far that is")
        .choice(&Params::detail, "detail", {"map", "pixel"},
                "what is too small for the light map's texels is lost, as in the source, or lit at the pixel")
        .choice(&Params::specular_shadow, "specular_shadow", {"off", "source", "shadow_map"},
                "the key light's specular: not shadowed, dimmed by the blurred light's luminance as in the "
                "source, or shadowed as the diffuse light is")
        .number(&Params::specular_shadow_scale, "specular_shadow_scale", "", 0, 10,
                "specular_shadow=source: times the luminance")
        .number(&Params::specular_shadow_bias, "specular_shadow_bias", "", -1, 1,
                "specular_shadow=source: added to it")
        .choice(&Params::specular, "specular", specular_model_names(), "specular model")
        .build();
}

}  // namespace dermis::texture_space
