// Wrapped diffuse: the cheapest imitation of scattering (Green 2004), with the energy-conserving scale of
// McAuley 2010. How far light reaches past the terminator follows from the skin's profile and the curvature,
// for each colour, or is set by eye as Green has it, with a colour shift at the terminator.

#include <algorithm>
#include <cmath>

#include "dermis/technique/forward.h"
#include "techniques/wrap/constants.h"

namespace dermis {
namespace {

enum class Width : int32_t { profile = kWidthProfile, source = kWidthSource };

struct Params {
    Width width = Width::profile;
    float wrap = 0.25f;
    float scatter_width = 0.15f;
    Vec3 scatter_color_linear = {0.07f, 0.012f, 0.006f};
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
        .choice(&Params::specular, "specular", specular_model_names(), "specular model")
        .build();
}

// For one colour, the reach at curvature k is second_moment k^2 / (1 + bend k^2), times kReachScale.
struct Reach {
    double second_moment_mm2 = 0, bend_mm2 = 0;
};

// On a sphere of curvature k the profile damps the cosine's part of the light (its zonal harmonic of order 1)
// by d(k) = sum w exp(-v k^2), and 1 - d is second_moment k^2 for small k. The bend is set so that 1 - d is
// also right at 1/2 per mm.
Reach reach_of(const GaussianSum& profile, size_t c) {
    constexpr double kSharpest = 0.25;  // (1/2 per mm)^2
    double total = 0, second_moment = 0, damped = 0;
    for (const GaussianTerm& term : profile.terms) {
        total += term.weight[c];
        second_moment += term.weight[c] * term.variance_mm2;
        damped += term.weight[c] * std::exp(-term.variance_mm2 * kSharpest);
    }
    if (!(second_moment > 0)) return {};
    second_moment /= total;
    const double lost = 1 - damped / total;
    return {second_moment, std::max(second_moment / lost - 1 / kSharpest, 0.0)};
}

PassList build(const ParameterValues& values, const FrameContext& frame) {
    const auto params = values.as<Params>();
    const Reach r = reach_of(frame.skin_gaussians, 0), g = reach_of(frame.skin_gaussians, 1),
                b = reach_of(frame.skin_gaussians, 2);
    Pass skin = forward_skin_pass("wrap/wrap.frag", params.specular, frame);
    skin.constants.emplace_back("width", int32_t(params.width));
    skin.values = {{"second_moment_mm2",
                    Vec3{float(r.second_moment_mm2), float(g.second_moment_mm2), float(b.second_moment_mm2)}},
                   {"bend_mm2", Vec3{float(r.bend_mm2), float(g.bend_mm2), float(b.bend_mm2)}}};
    return {.passes = {std::move(skin)}};
}

}  // namespace

Technique make_wrap_technique() {
    return {.id = "wrap",
            .summary = "wrapped diffuse, as far past the terminator as the profile scatters",
            .source = "Green 2004, GPU Gems, chapter 16; McAuley 2010, Energy-Conserving Wrapped Diffuse",
            .parameters = parameters(),
            .build = build};
}

}  // namespace dermis
