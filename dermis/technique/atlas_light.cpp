#include "dermis/technique/atlas_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dermis::inline technique {
namespace {

// Alpha of texels that were never written: 1 for blurs in texels, 0 for blurs in mm.
std::array<float, 4> nothing_written(bool in_mm) {
    return {0, 0, 0, in_mm ? 0.0f : 1.0f};
}

Pass metric_pass(const AtlasLightSettings& settings) {
    return {.name = "atlas metric",
            .kind = PassKind::geometry_uv_atlas,
            .shader = "atlas/metric.frag",
            .vertex_shader = "atlas/metric.vert",
            .colors = {{.image = "atlas_metric"}, {.image = "atlas_normal"}},
            .values = {{"size", float(settings.size)},
                       {"kernel_scale", settings.kernel_scale_mm},
                       {"kernel_bias", settings.kernel_bias_mm},
                       {"longest_texels", settings.longest_texels}}};
}

Pass carry_pass(const AtlasLightSettings& settings) {
    Pass pass = {.name = "carry seams",
                 .kind = PassKind::fullscreen,
                 .shader = "atlas/carry.frag",
                 .colors = {{.image = "light_map_a", .load = LoadOp::discard}}};
    read_atlas_metric(pass, "light_map_b", settings);
    return pass;
}

}  // namespace

const ParameterTable& atlas_parameters() {
    using P = AtlasParams;
    static const ParameterTable kTable =
        ParameterTableBuilder<P>()
            .integer(&P::light_map_size, "light_map_size", "texels", 16, 4096,
                     "side of the light map; up to twice as many where the atlas has gaps")
            .choice(&P::cull, "cull", {"none", "frustum", "back_face", "both"},
                    "leave out texels outside the view, or that face away; changes no pixel")
            .number(&P::kernel_growth, "kernel_growth", "", 0, 10,
                    "radii of the blur grow by this share where the kernel-size map is 1")
            .choice(&P::transmission, "transmission", transmission_names(), kTransmissionHelp)
            .choice(&P::gain, "gain", gain_names(), kGainHelp)
            .build();
    return kTable;
}

AtlasParams coarse_light_map(AtlasParams params, float scale) {
    constexpr int32_t kSmallest = 256;
    params.light_map_size =
        std::max(int32_t(float(params.light_map_size) * scale), std::min(params.light_map_size, kSmallest));
    return params;
}

int light_map_side(const AtlasParams& params, const FrameContext& frame) {
    constexpr int kMostTexels = 4096, kTile = 8;
    if (!(frame.light_map_scale > 1)) return params.light_map_size;
    const int tiles = int(std::ceil(float(params.light_map_size) * frame.light_map_scale / kTile));
    return std::min(kTile * tiles, kMostTexels);
}

AtlasLightSettings atlas_light_settings(const AtlasParams& params, const FrameContext& frame) {
    const AtlasCull cull = params.cull;
    const int side = light_map_side(params, frame);
    return {.cull = {.frustum = cull == AtlasCull::frustum || cull == AtlasCull::both,
                     .back_face = cull == AtlasCull::back_face || cull == AtlasCull::both,
                     .size = side},
            .size = side,
            .kernel_scale_mm = params.kernel_growth};
}

std::vector<NamedValue> atlas_skin_values(const std::function<Vec3(double texel_mm)>& kept,
                                          ShadowStrength shadow) {
    std::vector<NamedValue> values = {{"occluded", shadow.occluded},
                                      {"trans_shadow_alpha", shadow.trans_shadow_alpha}};
    for (int i = 0; i < kDetailSamples; ++i)
        values.emplace_back("detail_kept[" + std::to_string(i) + "]",
                            kept(double(kDetailFirstMm) * std::exp2(double(i) / kDetailPerOctave)));
    return values;
}

Vec3 kept_of_half_held_wave(const GaussianSum& blur, double texel_mm) {
    const double wave_mm = 2.5 * texel_mm;
    return profile_transfer(blur, 2 * std::numbers::pi * std::numbers::pi / (wave_mm * wave_mm));
}

float longest_step_texels(float length_mm, int size, const FrameContext& frame) {
    return std::clamp(length_mm * frame.densest_uv_per_mm * float(size), 0.01f, float(size) / 4);
}

double typical_texel_mm(int size, const FrameContext& frame) {
    return 1 / std::max(double(frame.typical_uv_per_mm) * size, 1e-6);
}

void add_atlas_light(PassList& list, const AtlasLightSettings& settings, const FrameContext& frame) {
    if (settings.in_mm) {
        list.seams = SeamRequest{.size = settings.size};
        for (const char* name : {"atlas_metric", "atlas_normal"})
            list.images.push_back(
                {.name = name, .format = ImageFormat::rgba16f, .size = {settings.size, settings.size}});
    }
    // Whole, as it says how far the light of each tile may come from.
    if (settings.in_mm) list.passes.push_back(metric_pass(settings));
    AtlasCullSettings cull = settings.cull;
    // The diagonal of two steps at right angles, each up to longest_texels long.
    cull.longest_texels = std::numbers::sqrt2_v<float> * settings.longest_texels;
    add_atlas_cull(list, cull);
    Pass light = {.name = "light map",
                  .kind = PassKind::geometry_uv_atlas,
                  .shader = "atlas/light.frag",
                  .colors = {{.image = settings.in_mm ? "light_map_b" : "light_map_a",
                              .clear = nothing_written(settings.in_mm)}},
                  .constants = {{"space", settings.in_mm ? kSpaceMm : kSpaceTexels}},
                  .values = {{"pre_scatter", settings.pre_scatter}}};
    reduce_diffuse(light, settings.specular, frame);
    read_shadow_channels(light, settings.shadow, frame);
    keep_unculled(light, settings.cull);
    list.passes.push_back(std::move(light));
    if (!settings.in_mm) return;
    Pass carry = carry_pass(settings);
    keep_unculled(carry, settings.cull);
    list.passes.push_back(std::move(carry));
}

void read_atlas_metric(Pass& pass, const std::string& source, const AtlasLightSettings& settings) {
    pass.reads.emplace_back("source", source);
    for (const char* name : {"atlas_metric", "seam_map", "chart_map"}) pass.reads.emplace_back(name);
    pass.constants.emplace_back("carry", int32_t(settings.carry_seams));
}

void read_atlas_walk(Pass& pass, const std::string& source, const AtlasLightSettings& settings,
                     float longest_way) {
    read_atlas_metric(pass, source, settings);
    pass.reads.emplace_back("atlas_normal");
    // A piece of a way must not be longer than gutters are wide.
    constexpr float kPieceTexels = 0.75f * float(SeamRequest{}.width_texels), kMostPieces = 8;
    const float pieces = std::ceil(longest_way * settings.longest_texels / kPieceTexels);
    pass.constants.emplace_back("pieces", int32_t(std::clamp(pieces, 1.0f, kMostPieces)));
}

}  // namespace dermis::inline technique
