#include "dermis/scene/scene_checks.h"

#include <algorithm>

#include "dermis/scene/scene_keys.h"

namespace dermis::inline scene {
namespace {

Error error_at(const SceneDescription& scene, int line, std::string message) {
    if (scene.file.empty()) return Error{std::move(message)};
    return Error{scene.file.string() + ":" + std::to_string(std::max(line, 1)) + ": " + std::move(message)};
}

Result<void> check_light(const SceneDescription& scene, const LightDescription& light) {
    const bool orbits = light.yaw_deg || light.pitch_deg || light.distance_mm;
    const bool directional = light.kind == LightKind::directional;
    if (directional && (light.position_mm || light.distance_mm))
        return error_at(
            scene, light.line,
            std::string("light.") + (light.position_mm ? "position_mm" : "distance_mm") +
                ": a directional light has none; give yaw_deg and pitch_deg, or kind = \"point\"");
    if (light.position_mm && orbits)
        return error_at(scene, light.line,
                        "light.position_mm excludes yaw_deg, pitch_deg and distance_mm; remove it or those");
    if (!directional && !light.position_mm && !light.distance_mm)
        return error_at(
            scene, light.line,
            "light: a point or spot light needs position_mm, or yaw_deg, pitch_deg and distance_mm");
    if (light.kind == LightKind::spot && light.inner_angle_deg >= light.outer_angle_deg)
        return error_at(scene, light.line, "light.inner_angle_deg must be smaller than outer_angle_deg");
    return {};
}

// Refuses keys of a mesh that a subject sets itself.
Result<void> check_mesh(const SceneDescription& scene, const MeshDescription& mesh) {
    if (!subject_name(mesh.file.text)) return {};
    if (mesh.subdivision > 0)
        return error_at(scene, mesh.line,
                        "mesh.subdivision: " + mesh.file.text + " is fine enough already; remove this key");
    if (mesh.unit_mm)
        return error_at(scene, mesh.line,
                        "mesh.unit_mm: " + mesh.file.text + " is in millimetres; use scale to resize it");
    return {};
}

Result<void> check_key_light(SceneDescription& scene) {
    if (scene.lights.size() == 1 && !scene.lights[0].key) scene.lights[0].key = true;
    const LightDescription* key = nullptr;
    for (const LightDescription& light : scene.lights) {
        if (!light.key.value_or(false)) continue;
        if (key)
            return error_at(scene, light.line,
                            "light.key: the light of line " + std::to_string(key->line) +
                                " is the key light already; exactly one casts the shadow");
        key = &light;
    }
    if (!scene.lights.empty() && !key)
        return error_at(scene, scene.lights[0].line,
                        "light.key: no light is the key light; give one of them key = true");
    return {};
}

Result<void> check_environment(const SceneDescription& scene) {
    if (!scene.environment) return {};
    const EnvironmentDescription& environment = *scene.environment;
    if (environment.kind == EnvironmentKind::file && !environment.file.given())
        return error_at(scene, environment.line, "environment.kind = \"file\" needs file = \"PANORAMA.hdr\"");
    if (environment.file.given() && environment.kind && *environment.kind != EnvironmentKind::file)
        return error_at(scene, environment.file.line,
                        "environment.file: only for kind = \"file\"; remove kind or file");
    return {};
}

Result<void> check_camera(const SceneDescription& scene) {
    const CameraDescription& camera = scene.camera;
    if (camera.eye_mm && (camera.yaw_deg || camera.pitch_deg || camera.distance_mm))
        return error_at(scene, camera.line,
                        "camera.eye_mm excludes yaw_deg, pitch_deg and distance_mm; remove it or those");
    return {};
}

bool any_material(const Scene& scene, const auto& holds) {
    return std::ranges::any_of(scene.objects, [&](const SceneObject& object) {
        return std::ranges::any_of(object.mesh.materials, holds);
    });
}

bool is_skin(const Scene& scene, std::string_view material) {
    for (const SceneObject& object : scene.objects)
        for (size_t i = 0; i < object.mesh.materials.size(); ++i)
            if (object.mesh.materials[i].name == material && object.classes[i] == MaterialClass::skin)
                return true;
    return false;
}

void warn_of_sections(const SceneDescription& description, const Scene& scene,
                      std::vector<std::string>& warnings) {
    const LightDescription light_defaults;
    for (const LightDescription& light : description.lights)
        if (light.kind != LightKind::spot && (light.inner_angle_deg != light_defaults.inner_angle_deg ||
                                              light.outer_angle_deg != light_defaults.outer_angle_deg))
            warnings.emplace_back(
                "light.inner_angle_deg and outer_angle_deg have no effect: they are for kind = \"spot\"");
    const auto& environment = description.environment;
    if (environment && environment->kind == EnvironmentKind::none &&
        (environment->yaw_deg != 0 || environment->intensity != 1 || environment->visible))
        warnings.emplace_back("the keys of [environment] have no effect beside kind = \"none\"");
    for (const auto& [name, material] : description.materials) {
        Material changed;
        for (const auto& [key, change] : material.changes) change(changed);
        if (changed.metallic > 0 && is_skin(scene, name))
            warnings.push_back("material." + name + ".metallic has no effect: skin is not a metal");
    }
}

}  // namespace

std::vector<std::string> keys_without_effect(const SceneDescription& description, const Scene& scene) {
    std::vector<const MapsDescription*> sections = {&description.maps};
    for (const auto& [name, material] : description.materials) sections.push_back(&material.maps);
    std::vector<std::string> warnings;
    for (const Key<MapsDescription>& key : maps_keys().keys()) {
        const auto gives = [&](const MapsDescription* maps) { return maps->changes.contains(key.info.name); };
        const auto has_map = [&](const Material& m) { return (m.*key.info.needs).present(); };
        if (key.info.needs && std::ranges::any_of(sections, gives) && !any_material(scene, has_map))
            warnings.push_back("maps." + key.info.name +
                               " has no effect: no material has the map that it is for");
    }
    const auto is_flat = [](const Material& m) {
        return m.displacement_map.present() && m.displacement_amplitude_mm == 0;
    };
    if (any_material(scene, is_flat))
        warnings.emplace_back(
            "a displacement map has no effect without displacement_amplitude_mm under "
            "[maps], the height in mm of a step of 1 in map value");
    warn_of_sections(description, scene, warnings);
    return warnings;
}

Result<void> check_scene(SceneDescription& scene) {
    if (scene.meshes.empty())
        return error_at(scene, 1, "no [[mesh]]; a scene has at least one, with file = \"HEAD.obj\"");
    for (const MeshDescription& mesh : scene.meshes)
        if (!mesh.file.given())
            return error_at(scene, mesh.line,
                            "mesh.file is missing; give file = \"HEAD.obj\" or \"builtin:spheres\"");
    for (const MeshDescription& mesh : scene.meshes)
        if (const Result<void> checked = check_mesh(scene, mesh); !checked) return checked;
    return check_views(scene);
}

Result<void> check_views(SceneDescription& scene) {
    for (const LightDescription& light : scene.lights)
        if (const Result<void> checked = check_light(scene, light); !checked) return checked;
    Result<void> checked = check_key_light(scene);
    if (checked) checked = check_environment(scene);
    if (checked) checked = check_camera(scene);
    return checked;
}

}  // namespace dermis::inline scene
