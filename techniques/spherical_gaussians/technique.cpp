// Pettineo 2020, "Approximating Subsurface Scattering with Spherical Gaussians": scattered light of one
// direction is a spherical Gaussian around that direction; its irradiance is Hill's fit. Changed: the
// sharpness follows from the profile and the curvature at the point, and any number of lobes add up to the
// profile.

#include "dermis/optics/gaussian_lobes.h"
#include "dermis/technique/forward.h"
#include "dermis/technique/gain.h"
#include "dermis/technique/transmission.h"
#include "techniques/spherical_gaussians/constants.h"

namespace dermis {
namespace {

using namespace spherical_gaussians;

struct Params {
    int32_t lobes = 2;
    LobeWidth width = LobeWidth::deviation;
    Transmission transmission = Transmission::shadow_map;
    Gain gain = Gain::curvature;
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
        .choice(&Params::gain, "gain", gain_names(), kGainHelp)
        .choice(&Params::specular, "specular", specular_model_names(), "specular model")
        .preset("cheap", "one lobe, no transmission", {.lobes = 1, .transmission = Transmission::none})
        .preset("best", "a lobe for each Gaussian of the profile", {.lobes = kMaxLobes})
        .build();
}

PassList build(const ParameterValues& values, const FrameContext& frame) {
    const auto params = values.as<Params>();
    Pass skin = forward_skin_pass("spherical_gaussians/spherical_gaussians.frag", params.specular, frame);
    skin.constants.emplace_back("lobe_count", params.lobes);
    read_transmission(skin, params.transmission, frame);
    use_gain(skin, params.gain);
    return {.passes = {std::move(skin)}};
}

Result<std::vector<TableImage>> tables(const ParameterValues& values, const SkinContext& skin) {
    return transmission_tables(values.as<Params>().transmission, skin);
}

// Lobes beyond the Gaussians of the profile get no weight.
Result<std::vector<NamedValue>> skin_values(const ParameterValues& values, const SkinContext& skin) {
    const auto params = values.as<Params>();
    std::vector<ChannelGaussians> lobes = lobes_of(skin.gaussians, params.lobes, params.width);
    lobes.resize(size_t(kMaxLobes));
    std::vector<NamedValue> block;
    for (size_t i = 0; i < lobes.size(); ++i) {
        const std::string index = "[" + std::to_string(i) + "]";
        block.emplace_back("lobe_weight" + index, to_vec3(lobes[i].weight));
        block.emplace_back("lobe_variance_mm2" + index, to_vec3(lobes[i].variance_mm2));
    }
    return block;
}

std::vector<Figure> figures() {
    struct Column {
        const char* label;
        const char* technique;
        std::vector<std::pair<std::string, std::string>> settings;
    };
    const Column columns[] = {
        {"integral over the sphere", "preintegrated", {}},
        {"Lambert", "lambert", {}},
        {"one lobe, the variance", "spherical_gaussians", {{"lobes", "1"}, {"width", "variance"}}},
        {"one lobe, the deviation", "spherical_gaussians", {{"lobes", "1"}}},
        {"two lobes", "spherical_gaussians", {{"lobes", "2"}}},
        {"six lobes", "spherical_gaussians", {{"lobes", "6"}}}};
    Figure figure = {.id = "spheres",
                     .title = "Spheres under one light",
                     .source = "Pettineo 2020: spheres by lobes of several widths beside a reference",
                     .note =
                         "One lobe cannot have both the narrow and the wide part of the profile: with the "
                         "profile's variance its light reaches too far past the terminator.",
                     .scene = "builtin:spheres",
                     .only_in_its_scene = true};
    for (const char* radius : {"2", "4", "8"}) {
        FigureRow row = {.label = std::string("r = ") + radius + " mm"};
        for (const Column& column : columns) {
            const bool exact = row.cells.empty();
            row.cells.push_back({.label = column.label,
                                 .id = exact ? std::string("exact") + radius : "",
                                 .technique = column.technique,
                                 .settings = column.settings,
                                 .view = "diffuse",
                                 .object = std::string("sphere_") + radius + "mm",
                                 .environment = "none",
                                 .compare_to = exact ? "" : std::string("exact") + radius});
        }
        figure.rows.push_back(std::move(row));
    }
    return {figure};
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
