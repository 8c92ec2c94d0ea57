// Jimenez, Zsolnai, Jarabo, Freude, Auzinger, Wu, von der Pahlen, Wimmer, Gutierrez 2015, "Separable
// Subsurface Scattering" (Computer Graphics Forum 34): the skin's diffuse light on the picture, before the
// base colour, is blurred along x and then along y by a one-dimensional kernel of the profile. Changed:
// distances are between points on the skin, and the weight of a tap is the kernel's integral over its cell
// (blur.frag).

#include "dermis/optics/artistic_kernel.h"
#include "dermis/technique/screen_light.h"
#include "techniques/screen_space_separable/constants.h"
#include "techniques/screen_space_separable/kernel.h"

namespace dermis {
namespace {

using namespace screen_space_separable;

constexpr const char* kOwnView = "blurred_light";
constexpr int kTexels = 256;

enum class Kernel : int32_t { profile, two_gaussians, artistic };
enum class Taps : int32_t { taps_7, taps_11, taps_17, taps_25 };
enum class Follow : int32_t { none = kFollowNone, surface = kFollowSurface };

struct Params {
    Kernel kernel = Kernel::profile;
    float width = 1;
    float near_mm = TwoGaussians().near_mm;
    float far_mm = TwoGaussians().far_mm;
    Vec3 far_share = TwoGaussians().far_share;
    Vec3 strength = to_vec3(ArtisticKernel().strength);
    Vec3 falloff = to_vec3(ArtisticKernel().falloff);
    Taps taps = Taps::taps_17;
    Follow follow = Follow::surface;
    Transmission transmission = Transmission::shadow_map;
    Gain gain = Gain::curvature;
    SpecularModel specular = SpecularModel::ggx;
};

ParameterTable parameters() {
    return ParameterTableBuilder<Params>()
        .choice(&Params::kernel, "kernel", {"profile", "two_gaussians", "artistic"},
                "the scene's profile along a line; two Gaussians, or strength and falloff, set by an artist")
        .number(&Params::width, "width", "", 0, 10, "scales the kernel's lengths")
        .number(&Params::near_mm, "near_mm", "mm", 0.01, 10, "kernel=two_gaussians: the narrower one")
        .number(&Params::far_mm, "far_mm", "mm", 0.01, 20, "kernel=two_gaussians: the wider one")
        .color(&Params::far_share, "far_share", 0, 1, "kernel=two_gaussians: share of the wider one")
        .color(&Params::strength, "strength", 0, 1, "kernel=artistic: the part of the light that is blurred")
        .color(&Params::falloff, "falloff", 0, 1, "kernel=artistic: widens the Gaussians of red skin")
        .choice(&Params::taps, "taps", {"7", "11", "17", "25"}, "taps along each direction")
        .choice(&Params::follow, "follow", {"none", "surface"},
                "distance to a tap: on the picture's plane, or between the points on the skin")
        .choice(&Params::transmission, "transmission", transmission_names(), kTransmissionHelp)
        .choice(&Params::gain, "gain", gain_names(), kGainHelp)
        .choice(&Params::specular, "specular", specular_model_names(), "specular model")
        .preset("cheap", "fewer taps", {.taps = Taps::taps_11})
        .preset("source_artists", "the source's own code: a kernel by strength and falloff",
                {.kernel = Kernel::artistic, .transmission = Transmission::none, .gain = Gain::none})
        .build();
}

int32_t half_taps(Taps taps) {
    constexpr int32_t kHalf[] = {3, 5, 8, 12};
    return kHalf[size_t(taps)];
}

GaussianSum kernel_of(const Params& params, const GaussianSum& skin) {
    const Vec3 strength = params.strength, falloff = params.falloff;
    if (params.kernel == Kernel::artistic)
        return line_kernel(
            {.strength = {strength.x, strength.y, strength.z}, .falloff = {falloff.x, falloff.y, falloff.z}});
    if (params.kernel != Kernel::two_gaussians) return skin;
    return to_gaussian_sum(
        TwoGaussians{.near_mm = params.near_mm, .far_mm = params.far_mm, .far_share = params.far_share});
}

PassList build(const ParameterValues& values, const FrameContext& frame) {
    const auto params = values.as<Params>();
    const float reach = reach_mm(kernel_of(params, frame.skin_gaussians), params.width);
    PassList list;
    add_screen_light(list, params.specular, frame);
    for (const char* name : {"skin_light_x", "skin_light_xy"})
        list.images.push_back({.name = name, .format = ImageFormat::rgba16f});
    for (const bool along_v : {false, true})
        list.passes.push_back(
            {.name = along_v ? "blur along y" : "blur along x",
             .kind = PassKind::fullscreen,
             .shader = "screen_space_separable/blur.frag",
             .reads = {{"light", along_v ? "skin_light_x" : "skin_light"}, "skin_z", "skin_kernel"},
             .colors = {{.image = along_v ? "skin_light_xy" : "skin_light_x", .load = LoadOp::discard}},
             .constants = {{"half_taps", half_taps(params.taps)},
                           {"along_v", int32_t(along_v)},
                           {"follow", int32_t(params.follow)}},
             .values = {{"reach_mm", reach}}});
    add_screen_skin(list, "skin_light_xy", params.specular, {params.transmission, params.gain}, frame,
                    kOwnView);
    return list;
}

// The light within a distance at sqrt(distance / reach), both ends included.
Result<std::vector<TableImage>> tables(const ParameterValues& values, const SkinContext& skin) {
    const auto params = values.as<Params>();
    const GaussianSum kernel = kernel_of(params, skin.gaussians);
    const double reach = reach_mm(kernel, params.width);
    std::vector<float> rgba;
    for (int i = 0; i < kTexels; ++i) {
        const double x = double(i) / (kTexels - 1);
        for (int c = 0; c < 3; ++c)
            rgba.push_back(float(share_within(kernel, params.width, c, reach * x * x) /
                                 share_within(kernel, params.width, c, reach)));
        rgba.push_back(1);
    }
    std::vector<TableImage> images = transmission_tables(params.transmission, skin);
    images.push_back(table_image("skin_kernel", 1, rgba));
    return images;
}

ParameterValues coarse(ParameterValues values, float) {
    auto params = values.as<Params>();
    params.taps = Taps::taps_7;
    values.put_all(params);
    return values;
}

}  // namespace

Technique make_screen_space_separable_technique() {
    return {.id = "screen_space_separable",
            .summary = "diffuse light blurred on the picture, along x, then y",
            .source = "Jimenez et al. 2015, Separable Subsurface Scattering",
            .parameters = parameters(),
            .views = {kOwnView},
            .build = build,
            .tables = tables,
            .coarse = coarse};
}

}  // namespace dermis
