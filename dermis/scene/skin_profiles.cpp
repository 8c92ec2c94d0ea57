#include "dermis/scene/skin_profiles.h"

#include <algorithm>

#include "dermis/optics/presets.h"
#include "dermis/scene/scene_files.h"

namespace dermis::inline scene {
namespace {

bool any_skin(const Scene& scene, const auto& holds) {
    return std::ranges::any_of(scene.objects, [&](const SceneObject& object) {
        return std::ranges::any_of(object.mesh.submeshes, [&](const Submesh& submesh) {
            return object.classes[submesh.material] == MaterialClass::skin && submesh.index_count > 0 &&
                   holds(object.mesh.materials[submesh.material]);
        });
    });
}

}  // namespace

const std::string& profile_of(const Scene& scene, const Material& material) {
    return material.profile.empty() ? scene.skin.profile : material.profile;
}

std::vector<std::string> skin_profiles(const Scene& scene) {
    std::vector<std::string> profiles;
    for (const SceneObject& object : scene.objects)
        for (const Submesh& submesh : object.mesh.submeshes) {
            if (object.classes[submesh.material] != MaterialClass::skin || submesh.index_count == 0) continue;
            const std::string& name = profile_of(scene, object.mesh.materials[submesh.material]);
            if (std::ranges::find(profiles, name) == profiles.end()) profiles.push_back(name);
        }
    if (profiles.empty()) profiles.push_back(scene.skin.profile);
    return profiles;
}

size_t profile_index(const Scene& scene, std::span<const std::string> profiles, const SceneObject& object,
                     uint32_t material) {
    if (material >= object.classes.size() || object.classes[material] != MaterialClass::skin) return 0;
    const auto found = std::ranges::find(profiles, profile_of(scene, object.mesh.materials[material]));
    return found == profiles.end() ? 0 : size_t(found - profiles.begin());
}

bool has_scatter_weights(const Scene& scene) {
    return any_skin(scene, [](const Material& m) { return m.scatter != 1 || m.scatter_map.present(); });
}

Result<void> resolve_profiles(Scene& scene, const std::filesystem::path& scene_file) {
    const std::string place = scene_file.empty() ? "" : scene_file.string() + ": ";
    for (SceneObject& object : scene.objects)
        for (Material& material : object.mesh.materials) {
            if (material.profile.empty()) continue;
            if (is_profile_file(material.profile))
                if (const auto file = resolve_path(material.profile, scene_file))
                    material.profile = file->string();
            if (const Result<Profile> known = find_profile(material.profile); !known)
                return Error{place + "material." + material.name + ".profile: " + known.error().message};
        }
    if (const size_t count = skin_profiles(scene).size(); count > kMostProfiles)
        return Error{place + "the skin has " + std::to_string(count) + " profiles; a scene can have " +
                     std::to_string(kMostProfiles)};
    return {};
}

}  // namespace dermis::inline scene
