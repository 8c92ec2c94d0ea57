#include "dermis/render/shared_passes.h"

#include <algorithm>

#include "dermis/technique/forward.h"
#include "shaders/renderer/constants.h"

namespace dermis::inline render {
namespace {

// `light`: index into Scene::lights, -1 for the key light.
Pass shadow_pass(int index, int light, bool has_cut_outs) {
    return {.name = "shadow" + (index > 0 ? " " + std::to_string(index) : ""),
            .kind = PassKind::geometry_light,
            .shader = has_cut_outs ? "renderer/cut_out.frag" : "",
            .depth = DepthTarget{.image = shadow_image("shadow_map", index)},
            .geometry = GeometryFilter::opaque,
            .constants = {{"from_light", int32_t(light)}}};
}

// Translucent surfaces in front of the first opaque one.
Pass shadow_tint_pass(int index, int light) {
    return {.name = "translucent shadow" + (index > 0 ? " " + std::to_string(index) : ""),
            .kind = PassKind::geometry_light,
            .shader = "renderer/shadow_tint.frag",
            .colors = {{.image = shadow_image("shadow_tint", index), .blend = Blend::additive}},
            .depth =
                DepthTarget{.image = shadow_image("shadow_map", index), .load = LoadOp::load, .write = false},
            .geometry = GeometryFilter::translucent,
            .constants = {{"from_light", int32_t(light)}}};
}

// The skin that the light reaches: what other surfaces shade is left out.
Pass lit_skin_pass(int index, int light, bool has_cut_outs) {
    return {.name = "lit skin" + (index > 0 ? " " + std::to_string(index) : ""),
            .kind = PassKind::geometry_light,
            .shader = "renderer/lit_skin.frag",
            .reads = {{"shadow_map", shadow_image("shadow_map", index)}},
            .depth = DepthTarget{.image = shadow_image("lit_skin", index)},
            .geometry = GeometryFilter::skin,
            .constants = {{"from_light", int32_t(light)}, {"has_cut_outs", int32_t(has_cut_outs)}}};
}

bool reads_image(const PassList& list, std::string_view image) {
    return std::ranges::any_of(list.passes, [&](const Pass& pass) {
        return std::ranges::any_of(pass.reads, [&](const auto& read) { return read.image == image; });
    });
}

void add_shadows(PassList& list, const SharedPassSettings& settings, bool lit_skin) {
    const ImageSize size = {settings.shadow_map_size, settings.shadow_map_size};
    std::vector<int> lights = {-1};
    lights.insert(lights.end(), settings.shadow_lights.begin(), settings.shadow_lights.end());
    for (int i = 0; i < int(lights.size()); ++i) {
        const int light = lights[size_t(i)];
        list.images.push_back(
            {.name = shadow_image("shadow_map", i), .format = ImageFormat::depth32f, .size = size});
        list.passes.push_back(shadow_pass(i, light, settings.has_cut_outs));
        if (lit_skin) {
            list.images.push_back(
                {.name = shadow_image("lit_skin", i), .format = ImageFormat::depth32f, .size = size});
            list.passes.push_back(lit_skin_pass(i, light, settings.has_cut_outs));
        }
        if (!settings.has_translucent) continue;
        list.images.push_back(
            {.name = shadow_image("shadow_tint", i), .format = ImageFormat::rgba16f, .size = size});
        list.passes.push_back(shadow_tint_pass(i, light));
    }
}

// Also clears depth, so that every later pass loads both.
Pass background_pass() {
    return {.name = "background",
            .kind = PassKind::fullscreen,
            .shader = "renderer/background.frag",
            .colors = {{.image = "radiance", .load = LoadOp::discard}},
            .depth = DepthTarget{.image = "depth", .write = false, .compare = Compare::always}};
}

Pass other_pass(const SharedPassSettings& settings) {
    Pass pass = {.name = "other",
                 .kind = PassKind::geometry_screen,
                 .shader = "renderer/standard.frag",
                 .colors = {{.image = "radiance", .load = LoadOp::load}},
                 .depth = DepthTarget{.image = "depth", .load = LoadOp::load},
                 .geometry = GeometryFilter::other,
                 .constants = {{"has_cut_outs", int32_t(settings.has_cut_outs)}}};
    read_shadows(pass, 1 + int(settings.shadow_lights.size()), settings.has_translucent);
    return pass;
}

// Cards of hair and lashes: where they cover more than half they hide what is behind, whatever the order of
// the draws; the rims, which hide nothing, then blend over that. A surface that is alone blends exactly.
std::vector<Pass> blended_passes(const SharedPassSettings& settings) {
    Pass core = other_pass(settings);
    core.name = "blended core";
    core.geometry = GeometryFilter::blended;
    core.colors[0].blend = Blend::alpha;
    core.constants.emplace_back("blended", kBlendedCore);
    Pass rim = core;
    rim.name = "blended rim";
    rim.depth->write = false;
    rim.constants.back().second = kBlendedRim;
    return {core, rim};
}

// Glass: multiplies what is behind it by the transmittance, then adds the reflection. The order of several
// surfaces does not matter within each pass.
std::vector<Pass> translucent_passes(const SharedPassSettings& settings) {
    constexpr uint32_t kColor = 7;
    const DepthTarget tested = {.image = "depth", .load = LoadOp::load, .write = false};
    Pass tint = other_pass(settings), gloss = other_pass(settings);
    tint.name = "translucent tint", gloss.name = "translucent";
    tint.shader = "renderer/translucent_tint.frag";
    tint.reads.clear();
    tint.constants.clear();
    tint.geometry = gloss.geometry = GeometryFilter::translucent;
    tint.depth = gloss.depth = tested;
    tint.colors[0].blend = Blend::multiply, gloss.colors[0].blend = Blend::additive;
    tint.colors[0].write_mask = gloss.colors[0].write_mask = kColor;
    return {tint, gloss};
}

Pass gbuffer_pass(const SharedPassSettings& settings) {
    Pass pass = {.name = "gbuffer",
                 .kind = PassKind::geometry_screen,
                 .shader = "renderer/gbuffer.frag",
                 .reads = {"shadow_map"},
                 .depth = DepthTarget{.image = "gbuffer_depth"},
                 .geometry = GeometryFilter::opaque,
                 .constants = {{"has_cut_outs", int32_t(settings.has_cut_outs)},
                               {"shows_tension", int32_t(settings.view == kTensionView)}}};
    for (const std::string& image : gbuffer_images()) pass.colors.push_back({.image = image});
    return pass;
}

static_assert(int(ToneMap::none) == kToneMapNone && int(ToneMap::hable) == kToneMapHable &&
              int(ToneMap::aces) == kToneMapAces && int(ToneMap::pbr_neutral) == kToneMapPbrNeutral);

Pass tone_map_pass(const SharedPassSettings& settings) {
    return {.name = "tone map",
            .kind = PassKind::fullscreen,
            .shader = "renderer/tone_map.frag",
            .reads = {{"radiance", radiance_image(settings)}},
            .colors = {{.image = "display", .load = LoadOp::discard}},
            .constants = {{"tone_map", int32_t(settings.tone_map)}}};
}

Pass view_pass(int32_t view) {
    Pass pass = {.name = "view",
                 .kind = PassKind::fullscreen,
                 .shader = "renderer/view.frag",
                 .colors = {{.image = "display", .load = LoadOp::discard}},
                 .constants = {{"shown", view}}};
    for (const std::string& image : gbuffer_images()) pass.reads.push_back(image);
    return pass;
}

// Passes of the kinds' own vertex shaders get those that read the stream "tension".
void read_tension(PassList& list) {
    for (Pass& pass : list.passes) {
        if (!pass.vertex_shader.empty()) continue;
        if (pass.kind == PassKind::geometry_screen) pass.vertex_shader = "renderer/mesh_screen_tension.vert";
        if (pass.kind == PassKind::geometry_uv_atlas)
            pass.vertex_shader = "renderer/mesh_uv_atlas_tension.vert";
    }
}

}  // namespace

const std::vector<std::string>& gbuffer_images() {
    static const std::vector<std::string> kNames = {"gbuffer_position", "gbuffer_normal", "gbuffer_geometry",
                                                    "gbuffer_albedo", "gbuffer_light"};
    return kNames;
}

const std::vector<std::string>& gbuffer_views() {
    static const std::vector<std::string> kNames = [] {
        std::vector<std::string> names(kShownCount);
        names[kShownNormal] = "normal";
        names[kShownGeometryNormal] = "geometry_normal";
        names[kShownAlbedo] = "albedo";
        names[kShownRoughness] = "roughness";
        names[kShownCurvature] = "curvature";
        names[kShownOcclusion] = "occlusion";
        names[kShownShadow] = "shadow";
        names[kShownNDotL] = "n_dot_l";
        names[kShownDepth] = "depth";
        names[kShownUv] = "uv";
        names[kShownPosition] = "position";
        names[kShownTension] = kTensionView;
        return names;
    }();
    return kNames;
}

std::vector<std::string> view_names(const Technique& technique) {
    std::vector<std::string> names = {"final", "diffuse", "specular"};
    names.insert(names.end(), technique.views.begin(), technique.views.end());
    names.insert(names.end(), gbuffer_views().begin(), gbuffer_views().end());
    return names;
}

std::string radiance_image(const SharedPassSettings& settings) {
    return settings.samples > 1 ? "radiance_resolved" : "radiance";
}

std::vector<std::string> shared_inputs() {
    return {"environment_cube", "environment_brdf", "no_image"};
}

namespace {

PassList passes_at_rest(const PassList& technique, const SharedPassSettings& settings) {
    const auto view = std::ranges::find(gbuffer_views(), settings.view);
    const bool shows_gbuffer = view != gbuffer_views().end();
    const ImageFormat radiance_format = settings.deep ? ImageFormat::rgba32f : ImageFormat::rgba16f;

    PassList list{.seams = technique.seams,
                  .diffused_normals = technique.diffused_normals,
                  .needed_maps = technique.needed_maps};
    list.images = {{.name = "radiance", .format = radiance_format, .samples = settings.samples},
                   {.name = "depth", .format = ImageFormat::depth32f, .samples = settings.samples},
                   {.name = "display", .format = settings.deep ? ImageFormat::rgba32f : ImageFormat::rgba8}};
    add_shadows(list, settings, reads_image(technique, "lit_skin"));
    if (settings.gbuffer || shows_gbuffer) {
        for (const std::string& image : gbuffer_images())
            list.images.push_back({.name = image, .format = ImageFormat::rgba32f});
        list.images.push_back({.name = "gbuffer_depth", .format = ImageFormat::depth32f});
        list.passes.push_back(gbuffer_pass(settings));
    }
    if (shows_gbuffer) {
        list.passes.push_back(view_pass(int32_t(view - gbuffer_views().begin())));
        if (!settings.gbuffer) return list;
    }

    list.passes.push_back(background_pass());
    list.images.insert(list.images.end(), technique.images.begin(), technique.images.end());
    list.passes.insert(list.passes.end(), technique.passes.begin(), technique.passes.end());
    if (settings.has_other) list.passes.push_back(other_pass(settings));
    if (settings.has_blended)
        for (Pass& pass : blended_passes(settings)) list.passes.push_back(std::move(pass));
    if (settings.has_translucent)
        for (Pass& pass : translucent_passes(settings)) list.passes.push_back(std::move(pass));
    if (settings.samples > 1) {
        list.images.push_back({.name = "radiance_resolved", .format = radiance_format});
        list.passes.push_back({.name = "resolve",
                               .kind = PassKind::resolve,
                               .reads = {"radiance"},
                               .colors = {{.image = "radiance_resolved", .load = LoadOp::discard}}});
    }
    if (!shows_gbuffer) list.passes.push_back(tone_map_pass(settings));
    return list;
}

}  // namespace

PassList frame_passes(const PassList& technique, const SharedPassSettings& settings) {
    PassList list = passes_at_rest(technique, settings);
    if (settings.has_tension) read_tension(list);
    return list;
}

}  // namespace dermis::inline render
