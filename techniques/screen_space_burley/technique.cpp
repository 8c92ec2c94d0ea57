// Golubev 2018, "Efficient Screen-Space Subsurface Scattering Using Burley's Normalized Diffusion in
// Real-Time" (SIGGRAPH course), after Christensen, Burley 2015, "Approximate Reflectance Profiles for
// Efficient Subsurface Scattering": the skin's diffuse light on the picture, before the base colour, is
// gathered from a disk whose samples follow the profile. Changed: any profile, sampled by the mean of its
// channels; the light that leaves within the pixel is computed, not sampled.

#include "dermis/technique/screen_light.h"
#include "techniques/screen_space_burley/tables.h"

namespace dermis {
namespace {

using namespace screen_space_burley;

constexpr const char* kOwnView = "gathered_light";
constexpr int kTexels = 512;

struct Params {
    int32_t samples = 16;
    float width = 1;
    bool rotate = true;
    Transmission transmission = Transmission::shadow_map;
    Gain gain = Gain::curvature;
    SpecularModel specular = SpecularModel::ggx;
};

ParameterTable parameters() {
    return ParameterTableBuilder<Params>()
        .integer(&Params::samples, "samples", "", 4, 2048, "samples of the disk at every pixel")
        .number(&Params::width, "width", "", 0.01, 10, "scales the profile's lengths")
        .toggle(&Params::rotate, "rotate", "turns the disk from pixel to pixel: noise instead of bands")
        .choice(&Params::transmission, "transmission", transmission_names(), kTransmissionHelp)
        .choice(&Params::gain, "gain", gain_names(), kGainHelp)
        .choice(&Params::specular, "specular", specular_model_names(), "specular model")
        .preset("cheap", "half of the samples", {.samples = 8})
        .preset("best", "four times the samples: hardly any noise in one frame", {.samples = 64})
        .build();
}

PassList build(const ParameterValues& values, const FrameContext& frame) {
    const auto params = values.as<Params>();
    PassList list;
    add_screen_light(list, params.specular, frame);
    list.images.push_back({.name = "skin_light_gathered", .format = ImageFormat::rgba16f});
    list.passes.push_back(
        {.name = "gather",
         .kind = PassKind::fullscreen,
         .shader = "screen_space_burley/gather.frag",
         .reads = {{"light", "skin_light"}, "skin_z", "skin_density", "skin_radius"},
         .colors = {{.image = "skin_light_gathered", .load = LoadOp::discard}},
         .constants = {{"sample_count", params.samples}, {"rotate", int32_t(params.rotate)}}});
    add_screen_skin(list, "skin_light_gathered", params.specular, {params.transmission, params.gain}, frame,
                    kOwnView);
    return list;
}

Result<std::vector<TableImage>> tables(const ParameterValues& values, const SkinContext& skin) {
    const auto params = values.as<Params>();
    const Profile profile = scaled(skin.profile, double(params.width));
    const double reach = reach_mm(profile);
    std::vector<Texel> density = radial_density(profile, reach, kTexels);
    const std::vector<Texel> part = part_within(profile, reach, kTexels);
    density.insert(density.end(), part.begin(), part.end());
    std::vector<TableImage> images = transmission_tables(params.transmission, skin);
    images.push_back(table_image("skin_density", 2, density));
    images.push_back(
        table_image("skin_radius", 1, radius_of_part(profile, reach, kTexels), ImageFormat::r32f));
    return images;
}

// The fewest samples whose noise is not visible.
ParameterValues coarse(ParameterValues values, float) {
    constexpr int32_t kFewest = 8;
    auto params = values.as<Params>();
    params.samples = std::min(params.samples, kFewest);
    values.put_all(params);
    return values;
}

}  // namespace

Technique make_screen_space_burley_technique() {
    return {.id = "screen_space_burley",
            .summary = "diffuse light gathered on the picture from a disk",
            .source = "Golubev 2018, Efficient Screen-Space Subsurface Scattering; Christensen, Burley 2015",
            .parameters = parameters(),
            .views = {kOwnView},
            .build = build,
            .tables = tables,
            .coarse = coarse};
}

}  // namespace dermis
