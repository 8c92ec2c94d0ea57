// Wrapped diffuse: the cheapest imitation of scattering (Green 2004), with the energy-conserving scale of
// McAuley 2010. The reach past the terminator follows from the skin's profile and the curvature, for each
// colour, or is set by eye with a colour shift at the terminator, as in the source.

#include "dermis/optics/wrap_reach.h"
#include "dermis/technique/forward.h"
#include "dermis/technique/gain.h"
#include "dermis/technique/transmission.h"
#include "techniques/wrap/constants.h"

namespace dermis {
namespace {

enum class Width : int32_t { profile = kWidthProfile, source = kWidthSource };

struct Params {
    Width width = Width::profile;
    float wrap = 0.25f;
    float scatter_width = 0.15f;
    Vec3 scatter_color_linear = {0.07f, 0.012f, 0.006f};
    Transmission transmission = Transmission::shadow_map;
    Gain gain = Gain::curvature;
    SpecularModel specular = SpecularModel::ggx;
};

ParameterTable parameters() {
    return ParameterTableBuilder<Params>()
        .choice(
            &Params::width, "width", {"profile", "source"},
            "how far light reaches past the terminator: by the skin's profile and the curvature, for each "
            "colour; or wrap, scatter_width and scatter_color_linear, set by eye as in the source")
        .number(&Params::wrap, "wrap", "", 0, 1,
                "width=source: how far past the terminator light reaches, in n_dot_l")
        .number(&Params::scatter_width, "scatter_width", "", 0.001, 0.5,
                "width=source: half width of the coloured band, in wrapped n_dot_l")
        .color(&Params::scatter_color_linear, "scatter_color_linear", 0, 1,
               "width=source: added irradiance in the middle of the band")
        .choice(&Params::transmission, "transmission", transmission_names(), kTransmissionHelp)
        .choice(&Params::gain, "gain", gain_names(), kGainHelp)
        .choice(&Params::specular, "specular", specular_model_names(), "specular model")
        .preset("source", "Green 2004: widths and colour by eye",
                {.width = Width::source, .transmission = Transmission::none, .gain = Gain::none})
        .build();
}

PassList build(const ParameterValues& values, const FrameContext& frame) {
    const auto params = values.as<Params>();
    const WrapReach reach = wrap_reach(frame.skin_gaussians);
    Pass skin = forward_skin_pass("wrap/wrap.frag", params.specular, frame);
    skin.constants.emplace_back("width", int32_t(params.width));
    skin.values = {{"second_moment_mm2", to_vec3(reach.second_moment_mm2)},
                   {"bend_mm2", to_vec3(reach.bend_mm2)}};
    read_transmission(skin, params.transmission, frame);
    use_gain(skin, params.gain);
    return {.passes = {std::move(skin)}};
}

Result<std::vector<TableImage>> tables(const ParameterValues& values, const SkinContext& skin) {
    return transmission_tables(values.as<Params>().transmission, skin);
}

}  // namespace

Technique make_wrap_technique() {
    return {.id = "wrap",
            .summary = "wrapped diffuse, as wide as the profile scatters",
            .source = "Green 2004, GPU Gems, chapter 16; McAuley 2010, Energy-Conserving Wrapped Diffuse",
            .parameters = parameters(),
            .build = build,
            .tables = tables};
}

}  // namespace dermis
