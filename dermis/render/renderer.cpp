#include "dermis/render/renderer.h"

#include <algorithm>
#include <utility>

#include "dermis/base/hash.h"
#include "dermis/base/text.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"
#include "dermis/rays/carried_bakes.h"
#include "dermis/rays/curvature_gain.h"
#include "dermis/rays/slab_gain.h"
#include "dermis/render/atlas_check.h"
#include "dermis/render/frame_values.h"
#include "dermis/render/legend.h"
#include "dermis/render/material_maps.h"
#include "dermis/render/profile_passes.h"
#include "dermis/render/seam_textures.h"
#include "dermis/render/walked_scene.h"
#include "dermis/scene/skin_profiles.h"
#include "dermis/scene/wrinkles.h"
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
    hasher.add(scene.environment.intensity).add(scene.environment.yaw_rad);
    for (const std::string& profile : skin_profiles(scene)) hasher.add(profile);
    hasher.add(scene.skin.specular_reduces_diffuse);
    return hasher.hex();
}

// The draws are in the order of the objects' submeshes (SceneOnDevice).
void number_profiles(const Scene& scene, std::vector<gpu::Draw>& draws) {
    const std::vector<std::string> profiles = skin_profiles(scene);
    auto draw = draws.begin();
    for (const SceneObject& object : scene.objects)
        for (const Submesh& submesh : object.mesh.submeshes)
            (draw++)->profile = int(profile_index(scene, profiles, object, submesh.material));
}

// Normals baked for the pose; with rest_bakes.normals baked for the rest pose and turned with the surface.
Result<DiffusedNormals> baked_normals(const Scene& scene, const GaussianSum& profile,
                                      const DiffusedNormalsRequest& request) {
    if (!scene.rest_bakes.normals) return bake_diffused_normals(scene, profile, request);
    Scene rest = without_objects(scene);
    rest.objects = scene.rest_objects;
    DERMIS_TRY_ASSIGN(const DiffusedNormals baked, bake_diffused_normals(rest, profile, request));
    return carried_normals(scene.rest_objects, scene.objects, baked);
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

Renderer::Renderer(gpu::Device& device, gpu::ShaderSource shaders, gpu::Executor executor, const Scene& scene)
    : device_(&device), shaders_(std::move(shaders)), executor_(std::move(executor)), scene_(&scene) {}

Result<Renderer> Renderer::create(gpu::Device& device, gpu::ShaderSource shaders, const Scene& scene) {
    DERMIS_TRY_ASSIGN(SceneOnDevice uploaded, SceneOnDevice::upload(device, scene));
    DERMIS_TRY_ASSIGN(gpu::Executor executor, gpu::Executor::create(device, shaders));
    Renderer renderer(device, std::move(shaders), std::move(executor), scene);
    renderer.owned_ = std::make_unique<SceneOnDevice>(std::move(uploaded));
    renderer.uploaded_ = renderer.owned_.get();
    renderer.warnings_ = renderer.uploaded_->warnings();
    return renderer;
}

Result<Renderer> Renderer::sibling(gpu::ShaderSource shaders) {
    DERMIS_TRY_ASSIGN(gpu::Executor executor, gpu::Executor::create(*device_, shaders));
    Renderer renderer(*device_, std::move(shaders), std::move(executor), *scene_);
    renderer.uploaded_ = uploaded_;
    return renderer;
}

Result<void> Renderer::environment_changed() {
    return uploaded_->replace_environment(*device_, *scene_);
}

Result<void> Renderer::vertices_moved() {
    drop_history();
    return uploaded_->replace_vertices(*device_, *scene_);
}

Result<bool> Renderer::pose_on_device(const ScenePoser& poser, const Pose& pose) {
    if (!deformer_) {
        DERMIS_TRY_ASSIGN(std::optional<Deformer> made,
                          Deformer::create(*device_, shaders_, *scene_, poser, uploaded_->geometries()));
        deformer_.emplace(std::move(made));
        if (const gpu::DeviceInfo& info = device_->info(); info.storage_buffers < Deformer::kStorageBuffers)
            warn("the CPU poses the mesh: its pass binds " + std::to_string(Deformer::kStorageBuffers) +
                 " storage buffers, and " + info.name + " binds " + std::to_string(info.storage_buffers) +
                 " at most; choose another device with --device");
    }
    if (!*deformer_) return false;
    drop_history();
    DERMIS_TRY(uploaded_->add_tensions(*device_, *scene_));
    DERMIS_TRY_ASSIGN(std::vector<TargetWeights> weights, (*deformer_)->pose(pose));
    uploaded_->replace_target_weights(*scene_, std::move(weights));
    return true;
}

Result<void> Renderer::objects_replaced() {
    forget_shape();
    deformer_.reset();
    return uploaded_->replace_objects(*device_, *scene_);
}

void Renderer::forget_shape() {
    drop_history();
    for (ProfileState& state : profiles_) state.diffused_normals_key.clear();
    linked_light_key_.clear();
    seams_.reset();
    atlas_fault_.reset();
}

// The fit behind a context takes tens of milliseconds, so the contexts are kept.
Result<void> Renderer::prepare_profiles() {
    std::vector<ProfileState> states;
    for (const std::string& name : skin_profiles(*scene_)) {
        const auto known = std::ranges::find_if(
            profiles_, [&](const ProfileState& state) { return state.skin.profile.name == name; });
        ProfileState state;
        if (known != profiles_.end()) {
            state = std::move(*known);
            known->skin.profile.name.clear();
        } else {
            DERMIS_TRY_ASSIGN(Profile profile, find_profile(name));
            GaussianSum sum = to_gaussian_sum(profile).sum;
            state.skin = SkinContext{.profile = std::move(profile), .gaussians = std::move(sum)};
            state.skin.profile.name = name;
        }
        state.skin.diffuse_table = scene_->skin.diffuse_table;
        state.skin.zonal_table = scene_->skin.zonal_table;
        state.skin.beckmann_table = scene_->skin.beckmann_table;
        states.push_back(std::move(state));
    }
    profiles_ = std::move(states);
    return {};
}

Result<void> Renderer::prepare_tables(const Technique& technique, const ParameterValues& values,
                                      ProfileState& state) {
    if (!technique.tables && !technique.skin_values) {
        state.tables.clear();
        state.tables_key.clear();
        return {};
    }
    const std::string key = settings_key(technique, values, state.skin);
    if (key == state.tables_key) return {};
    std::vector<TableImage> tables;
    if (technique.tables) {
        DERMIS_TRY_ASSIGN(tables, technique.tables(values, state.skin));
    }
    state.skin_values.clear();
    if (technique.skin_values) {
        DERMIS_TRY_ASSIGN(const std::vector<NamedValue> made, technique.skin_values(values, state.skin));
        state.skin_values = gpu::Values(made.begin(), made.end());
    }
    state.tables.clear();
    for (const TableImage& table : tables) {
        DERMIS_TRY_ASSIGN(gpu::Texture texture, gpu::Texture::upload(*device_, {.name = table.name,
                                                                                .format = table.format,
                                                                                .width = table.width,
                                                                                .height = table.height,
                                                                                .bytes = table.bytes}));
        state.tables.emplace(table.name, std::move(texture));
    }
    state.tables_key = key;
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

Result<PassList> Renderer::passes_of_profiles(const Technique& technique, const ParameterValues& values,
                                              FrameContext frame) {
    std::vector<PassList> lists;
    std::vector<std::string> tables;
    for (const auto& [name, texture] : profiles_.front().tables) tables.push_back(name);
    for (ProfileState& state : profiles_) {
        frame.skin_gaussians = state.skin.gaussians;
        DERMIS_TRY_ASSIGN(PassList list, passes_of(technique, values, frame));
        state.diffused_normals_request = list.diffused_normals;
        lists.push_back(std::move(list));
    }
    return join_profiles(lists, tables);
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

Result<void> Renderer::prepare_diffused_normals(ProfileState& state) {
    if (!state.diffused_normals_request) return {};
    std::string key = state.skin.profile.name + std::to_string(state.diffused_normals_request->size);
    if (key == state.diffused_normals_key) return {};
    DERMIS_TRY_ASSIGN(const DiffusedNormals baked,
                      baked_normals(*scene_, state.skin.gaussians, *state.diffused_normals_request));
    for (const gpu::TextureData& data : diffused_normals_textures(baked)) {
        DERMIS_TRY_ASSIGN(gpu::Texture texture, gpu::Texture::upload(*device_, data));
        state.diffused_normals.insert_or_assign(data.name, std::move(texture));
    }
    state.diffused_normals_key = std::move(key);
    return {};
}

// Walks, which are cached, for the first frame with a gain.
Result<void> Renderer::prepare_gains(const SharedPassSettings& shared) {
    const auto asks_for = [&](int32_t gain) {
        return std::ranges::any_of(list_.passes, [&](const Pass& pass) {
            return std::ranges::find(pass.constants, std::pair(std::string(kGainConstant), gain)) !=
                   pass.constants.end();
        });
    };
    const bool by_curvature = asks_for(kGainCurvature), by_map = asks_for(kGainMap);
    if (by_map) DERMIS_TRY(prepare_walked_gains());
    draws_linked_light_ = asks_for(kGainLinks);
    if (draws_linked_light_) DERMIS_TRY(prepare_linked_light(shared));
    if (!by_curvature && !by_map) return {};
    for (ProfileState& state : profiles_) {
        if (state.has_gain_form) continue;
        state.gain_form = walked_gain_form(walk_medium_of(state.skin.profile));
        state.slab_gain = walked_slab_gain(state.skin.profile);
        state.has_gain_form = true;
    }
    return {};
}

// Each vertex has the gain of its material's profile.
Result<void> Renderer::prepare_walked_gains() {
    std::string key = walks_key(*scene_, Gain::map);
    if (key == uploaded_->gains_key) return {};
    DERMIS_TRY_ASSIGN(const std::vector<std::vector<Vec3>> gains, walk_scene_gains(*scene_));
    DERMIS_TRY(uploaded_->replace_gains(*device_, gains));
    uploaded_->gains_key = std::move(key);
    return {};
}

// Its passes fill the stream of the gains.
Result<void> Renderer::prepare_linked_light(const SharedPassSettings& shared) {
    std::string key = walks_key(*scene_, Gain::links);
    if (key != linked_light_key_) {
        DERMIS_TRY(LinkedLight::check(*scene_));
        DERMIS_TRY_ASSIGN(const VertexLinks links, walk_scene_links(*scene_));
        DERMIS_TRY_ASSIGN(linked_light_, LinkedLight::upload(*device_, *scene_, links));
        linked_light_key_ = std::move(key);
    }
    uploaded_->gains_key = linked_light_key_;
    linked_light_->add_passes(list_, shared);
    return {};
}

gpu::FrameInputs Renderer::inputs(const ParameterValues& values, const DrawSettings& settings) const {
    gpu::FrameInputs inputs = {.width = settings.width, .height = settings.height};
    inputs.textures["environment_cube"] = &uploaded_->environment_cube();
    inputs.textures["environment_brdf"] = &uploaded_->environment_brdf();
    inputs.textures["no_image"] = &uploaded_->no_image();
    inputs.textures["view_legend"] = legend_.get();
    if (list_.seams && seams_) {
        inputs.textures["seam_map"] = &seams_->seam_map;
        inputs.textures["chart_map"] = &seams_->chart_map;
    }
    for (size_t i = 0; i < profiles_.size(); ++i) {
        const ProfileState& state = profiles_[i];
        const auto own = [&](const std::string& name) { return profile_name(name, int(i)); };
        for (const auto& [name, texture] : state.tables) inputs.textures[own(name)] = &texture;
        if (state.diffused_normals_request)
            for (const auto& [name, texture] : state.diffused_normals) inputs.textures[own(name)] = &texture;
        inputs.blocks[own("Skin")] = state.skin_values;
        inputs.blocks[own("Frame")] =
            frame_values(*scene_, {.width = settings.width,
                                   .height = settings.height,
                                   .shadow_map_size = settings.shadow_map_size,
                                   .penumbra_mm = settings.penumbra_mm,
                                   .environment_mip_count = uploaded_->environment_mip_count(),
                                   .environment_sh = uploaded_->environment_sh(),
                                   .gain = state.gain_form,
                                   .slab_gain = state.slab_gain});
    }
    inputs.blocks["Params"] = parameter_block(values);
    inputs.arrays["Lights"] = light_values(*scene_);
    inputs.draws = uploaded_->draws();
    number_profiles(*scene_, inputs.draws);
    if (draws_linked_light_) linked_light_->add_inputs(uploaded_->geometries(), inputs);
    return inputs;
}

// The list and what it reads. The frame counts as drawn from here on; where it fails, the history is lost.
Result<void> Renderer::prepare(const Technique& technique, const ParameterValues& values,
                               const DrawSettings& settings) {
    const std::vector<std::string> views = view_names(technique);
    if (std::ranges::find(views, settings.view) == views.end())
        return Error{unknown_name("view", settings.view, views)};
    DERMIS_TRY(check_settings(technique, values));
    DERMIS_TRY(prepare_profiles());
    for (ProfileState& state : profiles_) DERMIS_TRY(prepare_tables(technique, values, state));
    DERMIS_TRY(prepare_legend(settings.view));

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
        .light_map_scale = uploaded_->uv_density().light_map_scale,
        .has_zonal_table = !scene_->skin.zonal_table.empty(),
        .has_beckmann_table = !scene_->skin.beckmann_table.empty(),
        .skin_gaussians = {}};
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
                                       .gbuffer = settings.gbuffer,
                                       .has_tension = uploaded_->has_tension()};
    DERMIS_TRY_ASSIGN(const PassList own, passes_of_profiles(technique, values, frame));
    list_ = frame_passes(own, shared);
    list_.constants = uploaded_->map_constants();
    list_.constants.emplace_back("has_scatter", has_scatter_weights(*scene_));
    list_.constants.emplace_back("has_wrinkles", uploaded_->has_tension() && has_wrinkles(*scene_));
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
    for (ProfileState& state : profiles_) DERMIS_TRY(prepare_diffused_normals(state));
    DERMIS_TRY(prepare_gains(shared));
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
