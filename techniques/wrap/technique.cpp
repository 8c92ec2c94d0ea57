// Wrapped diffuse with a colour shift at the terminator: the cheapest imitation of scattering (Green 2004),
// with the energy-conserving scale of McAuley 2010. Its widths are tuned by eye and know nothing of the skin
// or of millimetres.

#include "dermis/technique/forward.h"

namespace dermis {
namespace {

struct Params {
    float wrap = 0.25f;
    float scatter_width = 0.15f;
    Vec3 scatter_color_linear = {0.07f, 0.012f, 0.006f};
    SpecularModel specular = SpecularModel::ggx;
};

ParameterTable parameters() {
    return ParameterTableBuilder<Params>()
        .number(&Params::wrap, "wrap", "", 0, 1, "how far past the terminator light reaches, in n_dot_l")
        .number(&Params::scatter_width, "scatter_width", "", 0.001, 0.5,
                "half width of the coloured band, in wrapped n_dot_l")
        .color(&Params::scatter_color_linear, "scatter_color_linear", 0, 1,
               "added irradiance in the middle of the band")
        .choice(&Params::specular, "specular", specular_model_names(), "specular model")
        .build();
}

PassList build(const ParameterValues& values, const FrameContext& frame) {
    return {.passes = {forward_skin_pass("wrap/wrap.frag", values.as<Params>().specular, frame)}};
}

}  // namespace

Technique make_wrap_technique() {
    return {.id = "wrap",
            .summary = "wrapped diffuse with a colour shift at the terminator",
            .source = "Green 2004, GPU Gems, chapter 16; McAuley 2010, Energy-Conserving Wrapped Diffuse",
            .parameters = parameters(),
            .build = build};
}

}  // namespace dermis
