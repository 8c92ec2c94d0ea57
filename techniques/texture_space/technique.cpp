// Gosselin, Sander, Mitchell 2004, "Real-Time Texture-Space Skin Rendering" (ShaderX3): light the skin in its
// texture atlas, blur that image with a kernel whose size is painted, and read it back through the camera.
// Four steps: shadow map (shared), light map, dilation and blur, final mesh. The source's blur knows
// only texels, so its width on the skin depends on the UV layout; with space=mm it is in millimetres.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "techniques/texture_space/figures.h"
#include "techniques/texture_space/params.h"

namespace dermis {
namespace {

using texture_space::Blur;
using texture_space::BlurPass;
using texture_space::BlurPlan;
using texture_space::Dilate;
using texture_space::Filter;
using texture_space::Params;
using texture_space::Seams;
using texture_space::Space;

constexpr const char* kOwnView = "light_map";

// How far the passes after the light map carry light: the widest tap of every blur and its bilinear
// neighbour, and the bilinear lookups of the final mesh and of the light from across seams.
void set_reach(AtlasCullSettings& cull, const BlurPlan& plan) {
    cull.reach_texels = 2 + float(plan.passes.size());
    for (size_t i = 0; i < plan.passes.size(); ++i) {
        const float radius = plan.filter == Filter::kawase ? 1 : plan.passes[i].radius;
        const float way = widest_tap(plan.filter, i) * radius;
        if (plan.in_mm)
            cull.reach_steps += way * std::numbers::sqrt2_v<float>;  // to the corner of 3 x 3 taps
        else
            cull.reach_texels +=
                std::ceil(way * (plan.filter == Filter::kawase ? 1 : plan.kernel_scale + plan.kernel_bias));
    }
}

AtlasLightSettings atlas_settings(const Params& params, const BlurPlan& plan, const FrameContext& frame,
                                  bool whole) {
    const bool carry = params.seams == Seams::carry;
    const float kernel = plan.kernel_scale + plan.kernel_bias;
    AtlasLightSettings settings = atlas_light_settings(params.atlas);
    settings.size = settings.cull.size = plan.size;
    settings.in_mm = plan.in_mm;
    settings.specular = params.specular;
    settings.shadow.second_light = params.second_light_shadow;
    settings.shadow.single_channel = params.single_channel_opacity;
    settings.shadow.lookup = params.shadow_lookup;
    if (whole) settings.cull.frustum = settings.cull.back_face = false;
    settings.cull.exempt[0] = {params.exempt_1_u, params.exempt_1_v, params.exempt_1_radius};
    settings.cull.exempt[1] = {params.exempt_2_u, params.exempt_2_v, params.exempt_2_radius};
    settings.longest_texels = longest_step_texels(kernel, settings.size, frame);
    set_reach(settings.cull, plan);
    settings.cull.across_seams = settings.in_mm && carry;
    settings.carry_seams = carry;
    settings.kernel_scale_mm = plan.kernel_scale;
    settings.kernel_bias_mm = plan.kernel_bias;
    return settings;
}

constexpr std::array<float, 4> kNothingWritten = {0, 0, 0, 1};

// The image that pass `index` reads and that the pass before it wrote. The first reads light_map_a; the
// others alternate between light_map_b and light_map_a, or light_map_c where light_map_a is kept.
std::string source_of(const BlurPlan& plan, size_t index) {
    if (index % 2 == 1) return "light_map_b";
    return plan.keeps_lit && index > 0 ? "light_map_c" : "light_map_a";
}

Pass blur_pass(const Params& params, const BlurPlan& plan, size_t index) {
    // The source dilates in the first pass only; written_only must hold in all.
    const Dilate dilate = params.dilate == Dilate::source && index > 0 ? Dilate::off : params.dilate;
    const BlurPass& blur = plan.passes[index];
    return {
        .name = "blur " + std::to_string(index + 1),
        .kind = PassKind::fullscreen,
        .shader = "texture_space/blur.frag",
        .reads = {{"source", source_of(plan, index)}},
        .colors = {{.image = source_of(plan, index + 1), .load = LoadOp::discard, .clear = kNothingWritten}},
        .constants = {{"blur_filter", int32_t(plan.filter)},
                      {"dilate", int32_t(dilate)},
                      {"as_printed", int32_t(params.blur == Blur::source)}},
        .values = {{"radius", blur.radius},
                   {"kernel_scale", plan.kernel_scale},
                   {"kernel_bias", plan.kernel_bias},
                   {"pass_index", float(index)},
                   {"share", blur.share},
                   {"fitted_texel_mm", plan.fitted_texel_mm},
                   {"tap_variance", plan.tap_variance}}};
}

Pass blur_mm_pass(const Params& params, const BlurPlan& plan, const AtlasLightSettings& atlas, size_t index) {
    Pass pass = blur_pass(params, plan, index);
    const std::string from = pass.reads[0].image;
    pass.shader = "texture_space/blur_mm.frag";
    pass.reads.clear();
    std::erase_if(pass.constants, [](const auto& constant) { return constant.first == "dilate"; });
    pass.colors[0].clear = {0, 0, 0, 0};
    // The corners of 3 x 3 taps are farthest.
    read_atlas_walk(pass, from, atlas, std::numbers::sqrt2_v<float> * plan.passes[index].radius);
    return pass;
}

// Culls, light map and blur.
void add_light_map(PassList& list, const Params& params, const BlurPlan& plan,
                   const AtlasLightSettings& atlas, const FrameContext& frame) {
    add_atlas_light(list, atlas, frame);
    for (size_t i = 0; i < plan.passes.size(); ++i) {
        list.passes.push_back(atlas.in_mm ? blur_mm_pass(params, plan, atlas, i)
                                          : blur_pass(params, plan, i));
        keep_unculled(list.passes.back(), atlas.cull);
    }
}

int32_t texels_of(const Params& params, const BlurPlan& plan) {
    if (plan.in_mm) return kTexelsPremultiplied;
    return params.dilate == Dilate::written_only ? kTexelsWritten : kTexelsAsTheyAre;
}

PassList build(const ParameterValues& values, const FrameContext& frame) {
    const Params params = values.as<Params>();
    // Far away the light map of the frame before is used again. If that frame was far too, its map is
    // complete, because the first far frame draws all of it.
    const auto is_far = [&](float distance_mm) {
        return params.cull_distance && distance_mm > params.cull_beyond_mm;
    };
    const bool far = is_far(frame.camera_distance_mm);
    const bool kept = far && is_far(frame.previous_camera_distance_mm);

    const BlurPlan plan = blur_plan(params, frame);
    const ImageSize size = {plan.size, plan.size};
    const std::string result = source_of(plan, plan.passes.size());
    PassList list;
    for (const std::string name : {"light_map_a", "light_map_b", "light_map_c"}) {
        const bool read_later = name == result || (plan.keeps_lit && name == "light_map_a");
        const bool passed = name == "light_map_c" ? plan.keeps_lit && plan.passes.size() > 1
                                                  : !plan.passes.empty() || plan.in_mm;
        if (!read_later && (kept || !passed)) continue;
        list.images.push_back({.name = name,
                               .format = ImageFormat::rgba16f,
                               .size = size,
                               .persistent = params.cull_distance && read_later});
    }
    const AtlasLightSettings atlas = atlas_settings(params, plan, frame, far);
    add_shadow_channels(list, atlas.shadow, frame);
    if (!kept) add_light_map(list, params, plan, atlas, frame);

    Pass skin = forward_skin_pass("texture_space/final.frag", params.specular, frame, kOwnView);
    skin.reads = {{"light_map", result}, {"light_map_lit", plan.keeps_lit ? "light_map_a" : result}};
    skin.constants.insert(skin.constants.end(), {{"specular_shadow", int32_t(params.specular_shadow)},
                                                 {"light_map_texels", texels_of(params, plan)},
                                                 {"detail", plan.keeps_lit ? kDetailPixel : kDetailMap}});
    read_shadow_channels(skin, atlas.shadow, frame);
    read_transmission(skin, params.atlas.transmission, frame);
    list.passes.push_back(std::move(skin));
    return list;
}

ParameterValues coarse(ParameterValues values, float scale) {
    values.put_all(coarse_params(values.as<Params>(), scale));
    return values;
}

Result<std::vector<TableImage>> tables(const ParameterValues& values, const SkinContext& skin) {
    return transmission_tables(values.as<Params>().atlas.transmission, skin);
}

// A blur that is set takes the place of the profile. Without passes nothing is blurred, and all detail is
// kept.
Result<std::vector<NamedValue>> skin_values(const ParameterValues& values, const SkinContext& skin) {
    const Params params = values.as<Params>();
    const GaussianSum blur = params.blur == Blur::profile ? skin.gaussians : texture_space::set_blur(params);
    const bool in_texels = params.blur == Blur::set && params.space == Space::texels;
    return detail_values([&](double texel_mm) {
        return params.blur_passes == 0 ? Vec3{1, 1, 1}
                                       : kept_of_half_held_wave(blur, in_texels ? 1.0 : texel_mm);
    });
}

}  // namespace

Technique make_texture_space_technique() {
    return {.id = "texture_space",
            .summary = "diffuse light blurred in the skin's texture atlas",
            .source = "Gosselin, Sander, Mitchell 2004, Real-Time Texture-Space Skin Rendering",
            .parameters = texture_space::parameter_table(),
            .views = {kOwnView},
            .build = build,
            .tables = tables,
            .skin_values = skin_values,
            .coarse = coarse,
            .figures = texture_space_figures};
}

}  // namespace dermis
