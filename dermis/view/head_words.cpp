#include "dermis/view/head_words.h"

#include <algorithm>
#include <set>

#include "dermis/base/text.h"
#include "dermis/scene/find_parts.h"
#include "dermis/scene/scene_words.h"

namespace dermis::view {
namespace {

HeadMaterial head_material(const SceneObject& object, uint32_t number) {
    const Material& material = object.mesh.materials[number];
    const FoundPart& found = object.parts[number];
    std::vector<std::string> kinds;
    for (const NamedMap& map : maps_of(material)) kinds.emplace_back(map.kind);
    return {.name = material.name,
            .part = found.part,
            .reason = found.reason,
            .visible = std::ranges::any_of(
                object.mesh.submeshes, [&](const Submesh& submesh) { return submesh.material == number; }),
            .profile = material.profile,
            .maps = join(kinds, ", ")};
}

}  // namespace

std::vector<HeadMaterial> materials_of(const Scene& scene) {
    std::vector<HeadMaterial> materials;
    std::set<std::string> names;
    for (const SceneObject& object : scene.objects)
        for (uint32_t i = 0; i < object.parts.size(); ++i)
            if (const std::string& name = object.mesh.materials[i].name;
                !name.empty() && names.insert(name).second)
                materials.push_back(head_material(object, i));
    return materials;
}

bool has_guessed_classes(const Scene& scene) {
    return std::ranges::any_of(scene.objects,
                               [](const SceneObject& object) { return is_guessed(object.parts); });
}

std::vector<HeadMesh> meshes_of(const Scene& scene) {
    std::vector<HeadMesh> meshes;
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        const SceneObject& object = scene.objects[i];
        if (object.file.empty()) return {};
        const std::string number = scene.objects.size() > 1 ? std::to_string(i + 1) + "." : "";
        meshes.push_back({object.name, "mesh." + number + "unit_mm", object.unit_mm});
    }
    return meshes;
}

void put_word(std::vector<SceneWord>& words, SceneWord word) {
    const auto same = std::ranges::find(words, word.key, &SceneWord::key);
    if (same != words.end())
        *same = std::move(word);
    else
        words.push_back(std::move(word));
}

std::vector<SceneWord> words_beside_motion(std::vector<SceneWord> words) {
    std::erase_if(words, [](const SceneWord& word) { return is_motion_key(word.key); });
    return words;
}

bool has_other_unit(const Scene& seen, const Scene& fresh) {
    return !std::ranges::equal(seen.objects, fresh.objects, {}, &SceneObject::unit_mm, &SceneObject::unit_mm);
}

void scale_look(const Scene& seen, Scene& fresh) {
    const float ratio = fresh.bounds_radius_mm / seen.bounds_radius_mm;
    const auto moved = [&](Vec3 at_mm) {
        return fresh.bounds_center_mm + (at_mm - seen.bounds_center_mm) * ratio;
    };
    fresh.camera.eye_mm = moved(seen.camera.eye_mm);
    fresh.camera.target_mm = moved(seen.camera.target_mm);
    for (size_t i = 0; i < std::min(seen.lights.size(), fresh.lights.size()); ++i) {
        Light& light = fresh.lights[i];
        if (light.kind == LightKind::directional) continue;
        light.position_mm = moved(seen.lights[i].position_mm);
        light.intensity = seen.lights[i].intensity * ratio * ratio;  // the same irradiance
    }
}

}  // namespace dermis::view
