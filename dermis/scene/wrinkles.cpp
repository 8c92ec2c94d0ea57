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

WrinkleWeights wrinkle_weights(const Material& material, const TargetWeights& weights) {
    const auto weight = [&](const ImageSource& map, const std::string& target) {
        const auto found = map.present() ? weights.find(target) : weights.end();
        return found == weights.end() ? 0 : std::clamp(found->second, 0.0f, 1.0f);
    };
    return {weight(material.wrinkle_stretch_map, material.wrinkle_stretch_target),
            weight(material.wrinkle_compress_map, material.wrinkle_compress_target)};
}

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

Result<void> check_wrinkle_targets(const Scene& scene) {
    std::vector<std::string> targets;
    for (const SceneObject& object : scene.objects)
        targets.insert(targets.end(), object.motion.targets.begin(), object.motion.targets.end());
    for (const SceneObject& object : scene.objects)
        for (const Material& material : object.mesh.materials)
            for (const auto& [key, target] :
                 {std::pair{"wrinkle_stretch_target", &material.wrinkle_stretch_target},
                  std::pair{"wrinkle_compress_target", &material.wrinkle_compress_target}}) {
                if (target->empty() || std::ranges::count(targets, *target) > 0) continue;
                return Error{"material '" + material.name + "': " + key + ": " +
                             (targets.empty() ? "no mesh has morph targets"
                                              : unknown_name("morph target", *target, targets))};
            }
    return {};
}

bool shows_wrinkles(const SceneObject& object) {
    return std::ranges::any_of(object.mesh.materials, [&](const Material& material) {
        const WrinkleWeights weights = wrinkle_weights(material, object.target_weights);
        return has_wrinkle_map(material) &&
               (!object.mesh.tensions.empty() || weights.stretch > 0 || weights.compress > 0);
    });
}

std::vector<std::string> tension_warnings(const Scene& scene) {
    const bool reads_tension = scene.skin.blood_by_tension > 0 || has_wrinkles(scene);
    const auto moves = [](const SceneObject& object) { return !object.motion.empty(); };
    if (!reads_tension || std::ranges::any_of(scene.objects, moves)) return {};
    return {"wrinkle maps and skin.blood_by_tension show nothing: no mesh has clips or morph targets"};
}

Result<void> add_wrinkles(Hasher& hasher, const SceneObject& object) {
    if (!shows_wrinkles(object)) return {};
    hasher.add(object.mesh.tensions);
    for (const Material& material : object.mesh.materials) {
        const WrinkleWeights weights = wrinkle_weights(material, object.target_weights);
        if (weights.stretch > 0) hasher.add("stretch").add(weights.stretch);
        if (weights.compress > 0) hasher.add("compress").add(weights.compress);
        hasher.add(material.wrinkle_from).add(material.wrinkle_full);
        DERMIS_TRY(add_image(hasher, material.wrinkle_stretch_map));
        DERMIS_TRY(add_image(hasher, material.wrinkle_compress_map));
    }
    return {};
}

}  // namespace dermis::inline scene
