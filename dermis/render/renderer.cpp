#include "dermis/render/renderer.h"

#include <algorithm>
#include <utility>

#include "dermis/base/hash.h"
#include "dermis/base/text.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"
#include "dermis/rays/curvature_gain.h"
#include "dermis/rays/vertex_gain.h"
#include "dermis/render/atlas_check.h"
#include "dermis/render/frame_values.h"
#include "dermis/render/legend.h"
#include "dermis/render/material_maps.h"
#include "dermis/render/seam_textures.h"
#include "dermis/technique/gain.h"
#include "shaders/include/constants.h"

namespace dermis::inline render {
namespace {

// A technique's parameters as the block Params has them: choices and toggles are integers.
gpu::Values parameter_block(const ParameterValues& values) {
    gpu::Values block;
    for (const Parameter& parameter : values.table().parameters) {
        const std::array<double, 3> value = values.get(parameter);
        switch (parameter.kind) {
            case ParameterKind::number:
                block[parameter.name] = float(value[0]);
                break;
            case ParameterKind::color:
                block[parameter.name] = Vec3{float(value[0]), float(value[1]), float(value[2])};
                break;
            default:
                block[parameter.name] = int32_t(value[0]);
        }
    }
    return block;
}

std::string settings_key(const Technique& technique, const ParameterValues& values, const SkinContext& skin) {
    Hasher hasher;
    hasher.add(technique.id)
        .add(skin.profile.name)
        .add(skin.diffuse_table)
        .add(skin.zonal_table)
        .add(skin.beckmann_table);
    for (const Parameter& parameter : values.table().parameters) hasher.add(values.text(parameter));
    for (const GaussianTerm& term : skin.gaussians.terms)
        hasher.add(term.variance_mm2).add(term.weight[0]).add(term.weight[1]).add(term.weight[2]);
    return hasher.hex();
}

// Everything that the light on the surface depends on, except the scene's objects.
std::string light_key(const Technique& technique, const ParameterValues& values, const DrawSettings& settings,
                      const Scene& scene) {
    Hasher hasher;
    hasher.add(technique.id).add(settings.view).add(settings.shadow_map_size).add(settings.penumbra_mm);
    for (const Parameter& parameter : values.table().parameters) hasher.add(values.text(parameter));
    for (const gpu::Values& light : light_values(scene))
        for (const auto& [name, value] : light)
            std::visit([&](const auto& v) { hasher.add(std::as_bytes(std::span(&v, 1))); }, value);
    hasher.add(scene.environment.intensity).add(scene.environment.yaw_rad).add(scene.skin.profile);
    hasher.add(scene.skin.specular_reduces_diffuse);
    return hasher.hex();
}

// The light of each shadow map after the first.
std::vector<int> lights_by_shadow_map(const Scene& scene) {
    const std::vector<int> maps = scene.shadow_maps();
    std::vector<int> lights;
    for (int map = 1; map < kMaxShadowMaps; ++map) {
        const auto found = std::ranges::find(maps, map);
        if (found != maps.end()) lights.push_back(int(found - maps.begin()));
    }
    return lights;
}

}  // namespace

Renderer::Renderer(gpu::Device& device, gpu::Executor executor, const Scene& scene)
    : device_(&device), executor_(std::move(executor)), scene_(&scene) {}

Result<Renderer> Renderer::create(gpu::Device& device, gpu::ShaderSource shaders, const Scene& scene) {
    DERMIS_TRY_ASSIGN(SceneOnDevice uploaded, SceneOnDevice::upload(device, scene));
    DERMIS_TRY_ASSIGN(gpu::Executor executor, gpu::Executor::create(device, std::move(shaders)));
    Renderer renderer(device, std::move(executor), scene);
    renderer.owned_ = std::make_unique<SceneOnDevice>(std::move(uploaded));
    renderer.uploaded_ = renderer.owned_.get();
    renderer.warnings_ = renderer.uploaded_->warnings();
    return renderer;
}

Result<Renderer> Renderer::sibling(gpu::ShaderSource shaders) {
    DERMIS_TRY_ASSIGN(gpu::Executor executor, gpu::Executor::create(*device_, std::move(shaders)));
    Renderer renderer(*device_, std::move(executor), *scene_);
    renderer.uploaded_ = uploaded_;
    return renderer;
}

Result<void> Renderer::environment_changed() {
    return uploaded_->replace_environment(*device_, *scene_);
}

Result<void> Renderer::prepare_tables(const Technique& technique, const ParameterValues& values) {
    if (!technique.tables && !technique.skin_values) {
        tables_.clear();
        tables_key_.clear();
        return {};
    }
    DERMIS_TRY_ASSIGN(const SkinContext* skin, skin_context());
    const std::string key = settings_key(technique, values, *skin);
    if (key == tables_key_) return {};
    std::vector<TableImage> tables;
    if (technique.tables) {
        DERMIS_TRY_ASSIGN(tables, technique.tables(values, *skin));
    }
    skin_values_.clear();
    if (technique.skin_values) {
        DERMIS_TRY_ASSIGN(const std::vector<NamedValue> made, technique.skin_values(values, *skin));
        skin_values_ = gpu::Values(made.begin(), made.end());
    }
    tables_.clear();
    for (const TableImage& table : tables) {
        DERMIS_TRY_ASSIGN(gpu::Texture texture, gpu::Texture::upload(*device_, {.name = table.name,
                                                                                .format = table.format,
                                                                                .width = table.width,
                                                                                .height = table.height,
                                                                                .bytes = table.bytes}));
        tables_.emplace(table.name, std::move(texture));
    }
    tables_key_ = key;
    return {};
}

Result<void> Renderer::prepare_legend(const std::string& view) {
    // Views without a scale declare the texture too, but do not read it.
    if (legend_ && (!has_legend(view) || view == legend_view_)) return {};
    const Result<Image> ink = make_legend(view);
    if (!ink) return ink.error().within("view " + view);
    DERMIS_TRY_ASSIGN(gpu::Texture texture, gpu::Texture::upload(*device_, {.name = "view_legend",
                                                                            .format = ImageFormat::r8,
                                                                            .width = ink->width,
                                                                            .height = ink->height,
                                                                            .bytes = ink->bytes}));
    legend_ = std::make_unique<gpu::Texture>(std::move(texture));
    legend_view_ = view;
    return {};
}

// The fit behind it takes tens of milliseconds, so it is kept.
Result<const SkinContext*> Renderer::skin_context() {
    if (!skin_ || skin_->profile.name != scene_->skin.profile) {
        Result<Profile> profile = find_profile(scene_->skin.profile);
        if (!profile) return profile.error();
        GaussianSum sum = to_gaussian_sum(*profile).sum;
        skin_ = SkinContext{.profile = std::move(*profile), .gaussians = std::move(sum)};
        skin_->profile.name = scene_->skin.profile;
    }
    skin_->diffuse_table = scene_->skin.diffuse_table;
    skin_->zonal_table = scene_->skin.zonal_table;
    skin_->beckmann_table = scene_->skin.beckmann_table;
    return &*skin_;
}

// Where the technique asks for baked normals, a second list for the skin's atlas as it is.
Result<PassList> Renderer::passes_of(const Technique& technique, const ParameterValues& values,
                                     FrameContext frame) {
    PassList list = technique.build(values, frame);
    if (list.diffused_normals) {
        if (!atlas_fault_) {
            atlas_fault_ = unfit_for_baked_maps(*scene_);
            skin_outside_atlas_ = !atlas_fault_->empty() || has_skin_outside_atlas(*scene_);
        }
        frame.atlas_fault = *atlas_fault_;
        frame.has_skin_outside_atlas = skin_outside_atlas_;
        list = technique.build(values, frame);
    }
    if (!list.refusal.empty()) return Error{technique.id + ": " + list.refusal};
    for (const std::string& notice : list.notices) warn(technique.id + ": " + notice);
    return list;
}

void Renderer::warn(std::string warning) {
    if (std::ranges::find(warnings_, warning) == warnings_.end()) warnings_.push_back(std::move(warning));
}

// Once, for the first technique that has maps over the skin's atlas.
Result<void> Renderer::check_atlas() {
    const auto draws_atlas = [](const Pass& pass) { return pass.kind == PassKind::geometry_uv_atlas; };
    if (atlas_checked_ || (!list_.diffused_normals && std::ranges::none_of(list_.passes, draws_atlas)))
        return {};
    DERMIS_TRY_ASSIGN(std::vector<std::string> checked, check_skin_atlas(*scene_));
    warnings_.insert(warnings_.end(), checked.begin(), checked.end());
    atlas_checked_ = true;
    return {};
}

// Once for each material and map.
void Renderer::check_maps() {
    for (const std::string& name : list_.needed_maps)
        for (std::string& warning : missing_map_warnings(*scene_, name)) warn(std::move(warning));
}

Result<void> Renderer::prepare_seams() {
    if (!list_.seams || (seams_ && seams_->request == *list_.seams)) return {};
    DERMIS_TRY_ASSIGN(SeamTextures made, make_seam_textures(*device_, *scene_, *list_.seams));
    seams_ = std::move(made);
    return {};
}

Result<void> Renderer::prepare_diffused_normals(const GaussianSum& profile) {
    if (!list_.diffused_normals) return {};
    std::string key = scene_->skin.profile + std::to_string(list_.diffused_normals->size);
    if (key == diffused_normals_key_) return {};
    DERMIS_TRY_ASSIGN(const DiffusedNormals baked,
                      bake_diffused_normals(*scene_, profile, *list_.diffused_normals));
    for (const gpu::TextureData& data : diffused_normals_textures(baked)) {
        DERMIS_TRY_ASSIGN(gpu::Texture texture, gpu::Texture::upload(*device_, data));
        diffused_normals_.insert_or_assign(data.name, std::move(texture));
    }
    diffused_normals_key_ = std::move(key);
    return {};
}

// Walks, which are cached, for the first frame with a gain.
Result<void> Renderer::prepare_gain(const Profile& profile) {
    const auto asks_for = [&](int32_t gain) {
        return std::ranges::any_of(list_.passes, [&](const Pass& pass) {
            return std::ranges::find(pass.constants, std::pair(std::string(kGainConstant), gain)) !=
                   pass.constants.end();
        });
    };
    if (asks_for(kGainMap)) DERMIS_TRY(prepare_walked_gains(profile));
    if (!asks_for(kGainCurvature) || gain_profile_ == profile.name) return {};
    gain_form_ = walked_gain_form(walk_medium_of(profile));
    gain_profile_ = profile.name;
    return {};
}

Result<void> Renderer::prepare_walked_gains(const Profile& profile) {
    Hasher hasher;
    hasher.add(profile.name);
    for (const SceneObject& object : scene_->objects) hasher.add(object.classes);
    std::string key = hasher.hex();
    if (key == uploaded_->gains_key) return {};
    DERMIS_TRY_ASSIGN(const VertexGains walked, walk_vertex_gains(scene_->objects, walk_medium_of(profile)));
    DERMIS_TRY(uploaded_->replace_gains(*device_, walked.gains));
    uploaded_->gains_key = std::move(key);
    return {};
}

gpu::FrameInputs Renderer::inputs(const ParameterValues& values, const DrawSettings& settings) const {
    gpu::FrameInputs inputs = {.width = settings.width, .height = settings.height};
    inputs.textures["environment_cube"] = &uploaded_->environment_cube();
    inputs.textures["environment_brdf"] = &uploaded_->environment_brdf();
    inputs.textures["no_image"] = &uploaded_->no_image();
    for (const auto& [name, texture] : tables_) inputs.textures[name] = &texture;
    inputs.textures["view_legend"] = legend_.get();
    if (list_.seams && seams_) {
        inputs.textures["seam_map"] = &seams_->seam_map;
        inputs.textures["chart_map"] = &seams_->chart_map;
    }
    if (list_.diffused_normals)
        for (const auto& [name, texture] : diffused_normals_) inputs.textures[name] = &texture;
    inputs.blocks["Frame"] =
        frame_values(*scene_, {.width = settings.width,
                               .height = settings.height,
                               .shadow_map_size = settings.shadow_map_size,
                               .penumbra_mm = settings.penumbra_mm,
                               .environment_mip_count = uploaded_->environment_mip_count(),
                               .environment_sh = uploaded_->environment_sh(),
                               .gain = gain_form_});
    inputs.blocks["Params"] = parameter_block(values);
    inputs.blocks["Skin"] = skin_values_;
    inputs.arrays["Lights"] = light_values(*scene_);
    inputs.draws = uploaded_->draws();
    return inputs;
}

// The list and what it reads. The frame counts as drawn from here on; where it fails, the history is lost.
Result<void> Renderer::prepare(const Technique& technique, const ParameterValues& values,
                               const DrawSettings& settings) {
    const std::vector<std::string> views = view_names(technique);
    if (std::ranges::find(views, settings.view) == views.end())
        return Error{unknown_name("view", settings.view, views)};
    DERMIS_TRY(check_settings(technique, values));
    DERMIS_TRY(prepare_tables(technique, values));
    DERMIS_TRY(prepare_legend(settings.view));

    const Result<const SkinContext*> skin = skin_context();
    if (!skin) return skin.error();
    const std::string key = light_key(technique, values, settings, *scene_);
    const std::vector<int> shadow_lights = lights_by_shadow_map(*scene_);
    const FrameContext frame = {
        .view = settings.view,
        .camera_distance_mm = length(scene_->camera.eye_mm - scene_->bounds_center_mm),
        .previous_camera_distance_mm = key == history_key_ ? history_distance_mm_ : 0,
        .shadow_map_size = settings.shadow_map_size,
        .shadow_map_count = 1 + int(shadow_lights.size()),
        .has_other = uploaded_->has(gpu::DrawClass::other) || uploaded_->has(gpu::DrawClass::blended),
        .has_translucent = uploaded_->has(gpu::DrawClass::translucent),
        .has_second_light = scene_->lights.size() > 1,
        .reduced_diffuse = scene_->skin.specular_reduces_diffuse,
        .densest_uv_per_mm = uploaded_->uv_density().densest_uv_per_mm,
        .typical_uv_per_mm = uploaded_->uv_density().typical_uv_per_mm,
        .has_zonal_table = !scene_->skin.zonal_table.empty(),
        .has_beckmann_table = !scene_->skin.beckmann_table.empty(),
        .skin_gaussians = (*skin)->gaussians};
    const SharedPassSettings shared = {.samples = settings.samples,
                                       .shadow_map_size = settings.shadow_map_size,
                                       .shadow_lights = shadow_lights,
                                       .deep = settings.deep,
                                       .tone_map = scene_->tone_map,
                                       .view = settings.view,
                                       .has_other = uploaded_->has(gpu::DrawClass::other),
                                       .has_blended = uploaded_->has(gpu::DrawClass::blended),
                                       .has_translucent = uploaded_->has(gpu::DrawClass::translucent),
                                       .has_cut_outs = uploaded_->has_cut_outs(),
                                       .gbuffer = settings.gbuffer};
    DERMIS_TRY_ASSIGN(const PassList own, passes_of(technique, values, frame));
    list_ = frame_passes(own, shared);
    list_.constants = uploaded_->map_constants();
    list_.constants.emplace_back("one_light", scene_->lights.size() == 1);
    list_.constants.emplace_back("one_sample", settings.samples == 1);
    list_.constants.emplace_back("all_directional",
                                 std::ranges::all_of(scene_->lights, [](const Light& light) {
                                     return light.kind == LightKind::directional;
                                 }));
    radiance_name_ = radiance_image(shared);
    DERMIS_TRY(check_atlas());
    check_maps();
    DERMIS_TRY(prepare_seams());
    DERMIS_TRY(prepare_diffused_normals((*skin)->gaussians));
    DERMIS_TRY(prepare_gain((*skin)->profile));
    history_key_ = key;
    history_distance_mm_ = frame.camera_distance_mm;
    return {};
}

Result<gpu::FrameResult> Renderer::draw(const Technique& technique, const ParameterValues& values,
                                        const DrawSettings& settings) {
    DERMIS_TRY(prepare(technique, values, settings));
    Result<gpu::FrameResult> drawn = executor_.run(list_, inputs(values, settings));
    if (!drawn) history_key_.clear();
    return drawn;
}

Result<uint64_t> Renderer::submit(const Technique& technique, const ParameterValues& values,
                                  const DrawSettings& settings) {
    DERMIS_TRY(prepare(technique, values, settings));
    const Result<uint64_t> frame = executor_.submit(list_, inputs(values, settings));
    if (!frame) history_key_.clear();
    return frame;
}

Result<Image> Renderer::radiance() {
    return executor_.read(radiance_name_);
}
Result<Image> Renderer::display() {
    return executor_.read("display");
}
Result<Image> Renderer::read(std::string_view image) {
    return executor_.read(image);
}

}  // namespace dermis::inline render
