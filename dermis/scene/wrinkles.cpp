#include "dermis/scene/wrinkles.h"

#include <algorithm>

#include "dermis/base/text.h"
#include "dermis/scene/scene_hash.h"

namespace dermis::inline scene {
namespace {

bool has_wrinkle_map(const Material& material) {
    return material.wrinkle_stretch_map.present() || material.wrinkle_compress_map.present();
}

}  // namespace

bool has_wrinkles(const Scene& scene) {
    return std::ranges::any_of(scene.objects, [](const SceneObject& object) {
        return std::ranges::any_of(object.mesh.materials, has_wrinkle_map);
    });
}

Result<void> check_wrinkles(const Material& material) {
    if (!has_wrinkle_map(material)) return {};
    const std::string place = "material '" + material.name + "': ";
    if (!material.normal_map.present() || material.normal_space != NormalSpace::tangent)
        return Error{place +
                     "a wrinkle map is blended over a normal map in tangent space; give one as normal"};
    if (!(material.wrinkle_from < material.wrinkle_full))
        return Error{place + "wrinkle_from is " + to_text(material.wrinkle_from) +
                     "; it must be smaller than wrinkle_full, " + to_text(material.wrinkle_full)};
    return {};
}

std::vector<std::string> tension_warnings(const Scene& scene) {
    const bool reads_tension = scene.skin.blood_by_tension > 0 || has_wrinkles(scene);
    const auto moves = [](const SceneObject& object) { return !object.motion.empty(); };
    if (!reads_tension || std::ranges::any_of(scene.objects, moves)) return {};
    return {"wrinkle maps and skin.blood_by_tension show nothing: no mesh has clips or morph targets"};
}

Result<void> add_wrinkles(Hasher& hasher, const Mesh& mesh) {
    if (mesh.tensions.empty() || std::ranges::none_of(mesh.materials, has_wrinkle_map)) return {};
    hasher.add(mesh.tensions);
    for (const Material& material : mesh.materials) {
        hasher.add(material.wrinkle_from).add(material.wrinkle_full);
        DERMIS_TRY(add_image(hasher, material.wrinkle_stretch_map));
        DERMIS_TRY(add_image(hasher, material.wrinkle_compress_map));
    }
    return {};
}

}  // namespace dermis::inline scene
