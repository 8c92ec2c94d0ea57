// Pettineo 2020, "Approximating Subsurface Scattering with Spherical Gaussians": scattered light of one
// direction is a spherical Gaussian around that direction, as sharp as radius and profile say, and its
// irradiance is Hill's fit. Changed: the sharpness follows from the profile and the curvature at the point,
// and any number of lobes add up to the profile.

#include "dermis/optics/gaussian_lobes.h"
#include "dermis/technique/forward.h"
#include "dermis/technique/transmission.h"
#include "techniques/spherical_gaussians/constants.h"
#include "techniques/spherical_gaussians/figures.h"

namespace dermis {
namespace {

using namespace spherical_gaussians;

struct Params {
    int32_t lobes = 2;
    LobeWidth width = LobeWidth::deviation;
    Transmission transmission = Transmission::shadow_map;
    SpecularModel specular = SpecularModel::ggx;
};

ParameterTable parameters() {
    return ParameterTableBuilder<Params>()
        .integer(&Params::lobes, "lobes", "", 1, kMaxLobes,
                 "spherical Gaussians in each channel that replace the profile")
        .choice(&Params::width, "width", {"deviation", "variance"},
                "what a lobe keeps of the profile's Gaussians that it replaces: their mean standard "
                "deviation, so that the terminator has the right light, or their variance")
        .choice(&Params::transmission, "transmission", transmission_names(), kTransmissionHelp)
        .choice(&Params::specular, "specular", specular_model_names(), "specular model")
        .build();
}

PassList build(const ParameterValues& values, const FrameContext& frame) {
    const auto params = values.as<Params>();
    Pass skin = forward_skin_pass("spherical_gaussians/spherical_gaussians.frag", params.specular, frame);
    skin.constants.emplace_back("lobe_count", params.lobes);
    read_transmission(skin, params.transmission, frame);
    return {.passes = {std::move(skin)}};
}

Result<std::vector<TableImage>> tables(const ParameterValues& values, const SkinContext& skin) {
    return transmission_tables(values.as<Params>().transmission, skin);
}

// A profile may have fewer Gaussians than there are lobes: the rest have no weight.
Result<std::vector<NamedValue>> skin_values(const ParameterValues& values, const SkinContext& skin) {
    const auto params = values.as<Params>();
    std::vector<ChannelGaussians> lobes = lobes_of(skin.gaussians, params.lobes, params.width);
    lobes.resize(size_t(kMaxLobes));
    const auto to_vec3 = [](const Rgb& rgb) { return Vec3{float(rgb[0]), float(rgb[1]), float(rgb[2])}; };
    std::vector<NamedValue> block;
    for (size_t i = 0; i < lobes.size(); ++i) {
        const std::string index = "[" + std::to_string(i) + "]";
        block.emplace_back("lobe_weight" + index, to_vec3(lobes[i].weight));
        block.emplace_back("lobe_variance_mm2" + index, to_vec3(lobes[i].variance_mm2));
    }
    return block;
}

}  // namespace

Technique make_spherical_gaussians_technique() {
    return {
        .id = "spherical_gaussians",
        .summary = "lobes around the light, as wide as the profile",
        .source = "Pettineo 2020, Approximating Subsurface Scattering with Spherical Gaussians; Hill 2016",
        .parameters = parameters(),
        .build = build,
        .tables = tables,
        .skin_values = skin_values,
        .figures = figures};
}

}  // namespace dermis
