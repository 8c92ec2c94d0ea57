#include "dermis/scene/scene_hash.h"

#include <span>

#include "dermis/base/file.h"
#include "dermis/optics/presets.h"
#include "dermis/scene/skin_profiles.h"
#include "dermis/scene/wrinkles.h"

namespace dermis::inline scene {
namespace {

void add(Hasher& hasher, Vec3 v) {
    hasher.add(v.x).add(v.y).add(v.z);
}

Result<void> add(Hasher& hasher, const Material& m) {
    add(hasher, m.base_color_linear);
    add(hasher, m.emission_linear);
    hasher.add(m.opacity).add(m.alpha_mode).add(m.roughness).add(m.metallic).add(m.specular).add(m.ior);
    hasher.add(m.double_sided).add(m.normal_space).add(m.normal_scale).add(m.dilate_texels);
    for (const ImageSource* source :
         {&m.base_color_map, &m.emission_map, &m.normal_map, &m.metallic_roughness_map, &m.specular_map,
          &m.occlusion_map, &m.opacity_map, &m.roughness_map, &m.metallic_map})
        DERMIS_TRY(add_image(hasher, *source));
    // Only where they are used, so that references of other scenes stay valid.
    if (!m.profile.empty()) hasher.add(m.profile);
    if (m.scatter != 1) hasher.add(m.scatter);
    if (m.scatter_map.present()) DERMIS_TRY(add_image(hasher, m.scatter_map));
    hasher.add(cutoff_of_map(m));
    return add_image(hasher, cutoff_of_map(m) > 0 ? m.alpha_map : ImageSource{});
}

Result<void> add(Hasher& hasher, const SceneObject& object) {
    const Mesh& mesh = object.mesh;
    add_shape(hasher, object);
    hasher.add(mesh.tangents).add(mesh.uvs).add(mesh.occlusions).add(mesh.colors_linear);
    for (const Material& material : mesh.materials) DERMIS_TRY(add(hasher, material));
    return add_wrinkles(hasher, object);
}

void add(Hasher& hasher, const Light& light) {
    add(hasher, light.color_linear);
    add(hasher, light.to_light_world);
    add(hasher, light.position_mm);
    hasher.add(light.kind).add(light.intensity).add(light.inner_angle_rad).add(light.outer_angle_rad);
    hasher.add(light.is_key).add(light.casts_shadow);
}

void add(Hasher& hasher, const Camera& camera) {
    add(hasher, camera.eye_mm);
    add(hasher, camera.target_mm);
    add(hasher, camera.up_world);
    hasher.add(camera.vertical_fov_rad).add(camera.near_mm).add(camera.far_mm);
}

// Everything but the objects and the panorama.
void add_views(Hasher& hasher, const Scene& scene) {
    for (const Light& light : scene.lights) add(hasher, light);
    hasher.add(scene.shadow_map_budget);
    add(hasher, scene.camera);
    const Environment& environment = scene.environment;
    hasher.add(environment.kind).add(environment.intensity).add(environment.yaw_rad).add(environment.visible);
    add(hasher, scene.background_linear);
    hasher.add(scene.skin.profile);
    add(hasher, scene.skin.albedo_tint_linear);
    hasher.add(scene.skin.specular_reduces_diffuse);
}

// Nothing for scenes without a pose.
void add(Hasher& hasher, const Pose& pose) {
    if (pose.empty()) return;
    hasher.add(pose.clip).add(pose.time_s).add(pose.loop);
    for (const auto& [target, weight] : pose.morph) hasher.add(target).add(weight);
}

}  // namespace

void add_shape(Hasher& hasher, const SceneObject& object) {
    const Mesh& mesh = object.mesh;
    hasher.add(mesh.positions_mm).add(mesh.normals).add(mesh.indices).add(object.classes);
    for (const Submesh& part : mesh.submeshes)
        hasher.add(part.first_index).add(part.index_count).add(part.material);
}

Result<void> add_image(Hasher& hasher, const ImageSource& source) {
    hasher.add(source.present());
    if (!source.present()) return {};
    hasher.add(source.width).add(source.height).add(source.channels);
    hasher.add(source.encoded).add(source.pixels);
    hasher.add(source.wrap_u).add(source.wrap_v);
    if (!source.encoded.empty() || !source.pixels.empty()) return {};
    DERMIS_TRY_ASSIGN(const std::vector<std::byte> file, read_file(source.name));
    hasher.add(std::span(file));
    return {};
}

std::string hash_of_views(const Scene& scene) {
    Hasher hasher;
    add_views(hasher, scene);
    add(hasher, scene.motion.pose());
    hasher.add(scene.environment.file.string());
    return hasher.hex();
}

Result<std::string> hash_of(const Scene& scene) {
    Hasher hasher;
    for (const SceneObject& object : scene.objects) DERMIS_TRY(add(hasher, object));
    add_views(hasher, scene);
    std::vector<std::filesystem::path> files;
    if (scene.environment.kind == EnvironmentKind::file) files.push_back(scene.environment.file);
    for (const std::string& profile : skin_profiles(scene))
        if (is_profile_file(profile)) files.emplace_back(profile);
    for (const std::filesystem::path& path : files) {
        DERMIS_TRY_ASSIGN(const std::vector<std::byte> file, read_file(path));
        hasher.add(std::span(file));
    }
    return hasher.hex();
}

}  // namespace dermis::inline scene
