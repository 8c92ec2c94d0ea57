#include "dermis/scene/scene_hash.h"

#include <span>

#include "dermis/base/file.h"
#include "dermis/base/hash.h"
#include "dermis/optics/presets.h"

namespace dermis::inline scene {
namespace {

void add(Hasher& hasher, Vec3 v) {
    hasher.add(v.x).add(v.y).add(v.z);
}

template <class T>
void add_all(Hasher& hasher, const std::vector<T>& values) {
    hasher.add(std::as_bytes(std::span(values)));
}

// Pixels and embedded bytes, and files by their content.
Result<void> add(Hasher& hasher, const ImageSource& source) {
    hasher.add(source.present());
    if (!source.present()) return {};
    hasher.add(source.width).add(source.height).add(source.channels);
    hasher.add(std::span(source.encoded)).add(std::span(source.pixels));
    hasher.add(source.wrap_u).add(source.wrap_v);
    if (!source.encoded.empty() || !source.pixels.empty()) return {};
    DERMIS_TRY_ASSIGN(const std::vector<std::byte> file, read_file(source.name));
    hasher.add(std::span(file));
    return {};
}

Result<void> add(Hasher& hasher, const Material& m) {
    add(hasher, m.base_color_linear);
    add(hasher, m.emission_linear);
    hasher.add(m.opacity).add(m.alpha_mode).add(m.roughness).add(m.metallic).add(m.specular).add(m.ior);
    hasher.add(m.double_sided).add(m.normal_space).add(m.normal_scale).add(m.dilate_texels);
    for (const ImageSource* source :
         {&m.base_color_map, &m.emission_map, &m.normal_map, &m.metallic_roughness_map, &m.specular_map,
          &m.occlusion_map, &m.opacity_map, &m.roughness_map, &m.metallic_map})
        if (Result<void> added = add(hasher, *source); !added) return added;
    // Only where it counts, so that the cached reference of other scenes is found.
    if (cutoff_of_map(m) == 0) return {};
    hasher.add("cut out").add(cutoff_of_map(m));
    return add(hasher, m.alpha_map);
}

Result<void> add(Hasher& hasher, const SceneObject& object) {
    const Mesh& mesh = object.mesh;
    add_all(hasher, mesh.positions_mm);
    add_all(hasher, mesh.normals);
    add_all(hasher, mesh.tangents);
    add_all(hasher, mesh.uvs);
    add_all(hasher, mesh.occlusions);
    if (!mesh.colors_linear.empty()) {
        hasher.add("colours");
        add_all(hasher, mesh.colors_linear);
    }
    add_all(hasher, mesh.indices);
    for (const Submesh& part : mesh.submeshes)
        hasher.add(part.first_index).add(part.index_count).add(part.material);
    for (const MaterialClass material_class : object.classes) hasher.add(material_class);
    for (const Material& material : mesh.materials)
        if (Result<void> added = add(hasher, material); !added) return added;
    return {};
}

void add(Hasher& hasher, const Light& light) {
    add(hasher, light.color_linear);
    add(hasher, light.to_light_world);
    add(hasher, light.position_mm);
    hasher.add(light.kind).add(light.intensity).add(light.inner_angle_rad).add(light.outer_angle_rad);
    hasher.add(light.is_key);
    // Only where it is not the default, so that the hash of older scenes with one light stays the same.
    if (light.casts_shadow != light.is_key) hasher.add("shadow").add(light.casts_shadow);
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
    if (scene.shadow_map_budget != Scene{}.shadow_map_budget)
        hasher.add("shadow maps").add(scene.shadow_map_budget);
    add(hasher, scene.camera);
    const Environment& environment = scene.environment;
    hasher.add(environment.kind).add(environment.intensity).add(environment.yaw_rad).add(environment.visible);
    add(hasher, scene.background_linear);
    hasher.add(scene.skin.profile);
    add(hasher, scene.skin.albedo_tint_linear);
    if (scene.skin.specular_reduces_diffuse) hasher.add("specular reduces diffuse");
}

}  // namespace

std::string hash_of_views(const Scene& scene) {
    Hasher hasher;
    add_views(hasher, scene);
    hasher.add(scene.environment.file.string());
    return hasher.hex();
}

Result<std::string> hash_of(const Scene& scene) {
    Hasher hasher;
    for (const SceneObject& object : scene.objects) DERMIS_TRY(add(hasher, object));
    add_views(hasher, scene);
    std::vector<std::filesystem::path> files;
    if (scene.environment.kind == EnvironmentKind::file) files.push_back(scene.environment.file);
    if (is_profile_file(scene.skin.profile)) files.emplace_back(scene.skin.profile);
    for (const std::filesystem::path& path : files) {
        DERMIS_TRY_ASSIGN(const std::vector<std::byte> file, read_file(path));
        hasher.add(std::span(file));
    }
    return hasher.hex();
}

}  // namespace dermis::inline scene
