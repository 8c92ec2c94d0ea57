// Golubev 2018, "Efficient Screen-Space Subsurface Scattering Using Burley's Normalized Diffusion in
// Real-Time" (SIGGRAPH course), after Christensen, Burley 2015, "Approximate Reflectance Profiles for
// Efficient Subsurface Scattering": the skin's diffuse light on the picture, before the base colour, is
// gathered from a disk whose samples follow the profile. Changed: any profile, sampled by the mean of its
// channels; the part that leaves within the pixel is computed, not sampled. The number of samples can follow
// the variance, after Xie, Olano, Karis, Narkowicz 2020, "Real-Time Subsurface Scattering with Single Pass
// Variance-Guided Adaptive Importance Sampling": that of a few samples of this frame, where the source has
// that of earlier frames. Nothing lags behind a light that moves.

#include "dermis/technique/screen_light.h"
#include "techniques/screen_space_burley/constants.h"
#include "techniques/screen_space_burley/tables.h"

namespace dermis {
namespace {

using namespace screen_space_burley;

constexpr const char* kLightView = "gathered_light";
constexpr const char* kCountView = "sample_count";
constexpr int kTexels = 512;

enum class Count : int32_t { fixed, adaptive };
enum class Accumulate : int32_t { off, frames };

struct Params {
    Count count = Count::fixed;
    int32_t samples = 16;
    float noise = 0.003f;
    float width = 1;
    bool rotate = true;
    Accumulate accumulate = Accumulate::off;
    Transmission transmission = Transmission::shadow_map;
    SpecularModel specular = SpecularModel::ggx;
};

ParameterTable parameters() {
    return ParameterTableBuilder<Params>()
        .choice(&Params::count, "count", {"fixed", "adaptive"},
                "samples of the disk: as many at every pixel, or as the light around it varies")
        .integer(&Params::samples, "samples", "", 4, 2048,
                 "samples of the disk; count=adaptive: the most at a pixel")
        .number(&Params::noise, "noise", "", 0.0001, 1,
                "count=adaptive: standard deviation aimed at, over the brightest light within reach")
        .number(&Params::width, "width", "", 0.01, 10, "scales the profile's lengths")
        .toggle(&Params::rotate, "rotate", "turns the disk from pixel to pixel: noise instead of bands")
        .choice(&Params::accumulate, "accumulate", {"off", "frames"},
                "frames: samples of earlier frames count too, where the camera saw the point then")
        .choice(&Params::transmission, "transmission", transmission_names(), kTransmissionHelp)
        .choice(&Params::specular, "specular", specular_model_names(), "specular model")
        .build();
}

std::string turn_of(int frame) {
    return frame % 2 == 0 ? "_even" : "_odd";
}

std::vector<ImageRead> disk_reads() {
    return {{"light", "skin_light"}, "skin_z", "skin_density", "skin_radius"};
}

// A pass over the picture that samples the disk.
Pass disk_pass(const Params& params, const char* name, const char* shader, int32_t samples) {
    return {.name = name,
            .kind = PassKind::fullscreen,
            .shader = shader,
            .reads = disk_reads(),
            .constants = {{"sample_count", samples},
                          {"rotate", int32_t(params.rotate)},
                          {"accumulate", int32_t(params.accumulate)}}};
}

// Each frame reads what the frame before wrote, so two sets of images take turns.
void add_accumulation(PassList& list, const FrameContext& frame) {
    list.frames_to_settle = kMostFrames;
    list.images.push_back({.name = "skin_light_accumulated", .format = ImageFormat::rgba16f});
    for (const char* turn : {"_even", "_odd"}) {
        list.images.push_back(
            {.name = std::string("accumulated") + turn, .format = ImageFormat::rgba32f, .persistent = true});
        list.images.push_back(
            {.name = std::string("accumulated_z") + turn, .format = ImageFormat::r32f, .persistent = true});
    }
    const std::string now = turn_of(frame.earlier_frames), before = turn_of(frame.earlier_frames + 1);
    const bool same_light = frame.earlier_frames == 0 || frame.previous_camera_distance_mm > 0;
    Pass pass = {.name = "accumulate",
                 .kind = PassKind::fullscreen,
                 .shader = "screen_space_burley/accumulate.frag",
                 .reads = disk_reads()};
    pass.reads.insert(pass.reads.end(), {{"light_around_now", "skin_light_gathered"},
                                         {"light_before", "accumulated" + before},
                                         {"z_before", "accumulated_z" + before}});
    for (const std::string& image :
         {std::string("skin_light_accumulated"), "accumulated" + now, "accumulated_z" + now})
        pass.colors.push_back({.image = image, .load = LoadOp::discard});
    pass.values = {{"light_changes", same_light ? 0.0f : 1.0f}};
    list.passes.push_back(std::move(pass));
}

void add_pilot(PassList& list, const Params& params) {
    list.images.push_back({.name = "pilot", .format = ImageFormat::rgba32f, .size = {.frame_scale = 0.5f}});
    Pass pilot = disk_pass(params, "pilot", "screen_space_burley/pilot.frag", kPilotSamples);
    pilot.colors = {{.image = "pilot", .load = LoadOp::discard}};
    list.passes.push_back(std::move(pilot));
}

PassList build(const ParameterValues& values, const FrameContext& frame) {
    const auto params = values.as<Params>();
    const bool adaptive = params.count == Count::adaptive, shows_count = frame.view == kCountView;
    const bool accumulates = params.accumulate == Accumulate::frames && !shows_count;
    PassList list;
    add_screen_light(list, params.specular, frame);
    list.images.push_back(
        {.name = "skin_light_gathered", .format = accumulates ? ImageFormat::rgba32f : ImageFormat::rgba16f});
    if (adaptive) add_pilot(list, params);
    Pass gather = disk_pass(
        params, "gather", adaptive ? "screen_space_burley/adaptive.frag" : "screen_space_burley/gather.frag",
        params.samples);
    if (adaptive) {
        gather.reads.push_back("pilot");
        gather.values = {{"noise", params.noise}};
    }
    gather.constants.emplace_back("show_count", int32_t(shows_count));
    gather.colors = {{.image = "skin_light_gathered", .load = LoadOp::discard}};
    list.passes.push_back(std::move(gather));
    if (accumulates) add_accumulation(list, frame);
    add_screen_skin(list, accumulates ? "skin_light_accumulated" : "skin_light_gathered", params.specular,
                    params.transmission, frame, shows_count ? kCountView : kLightView);
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

// The minimum at which single samples are not visible.
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
            .summary = "diffuse light gathered on the picture from a disk of samples",
            .source = "Golubev 2018, Efficient Screen-Space Subsurface Scattering; Christensen, Burley 2015",
            .parameters = parameters(),
            .views = {kLightView, kCountView},
            .build = build,
            .tables = tables,
            .coarse = coarse};
}

}  // namespace dermis
