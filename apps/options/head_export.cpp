#include "head_export.h"

#include <algorithm>
#include <atomic>

#include "catalog/catalog.h"
#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
#include "dermis/base/progress.h"
#include "dermis/optics/diffused_normals.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"
#include "dermis/rays/bake_map.h"
#include "dermis/rays/ray_scene.h"
#include "dermis/rays/rays_version.h"
#include "dermis/render/atlas_check.h"
#include "dermis/render/complete_scene.h"
#include "dermis/scene/scene_files.h"
#include "dermis/scene/scene_hash.h"
#include "dermis/technique/pass_list.h"

namespace dermis::cli {
namespace {

constexpr int kThicknessSize = 1024;

Result<const Technique*> preintegrated() {
    return find_technique(built_in_catalog().techniques, "preintegrated");
}

SkinContext skin_context(const Profile& profile) {
    return {.profile = profile, .gaussians = to_gaussian_sum(profile).sum};
}

Result<std::array<Vec3, 3>> occlusion_weights(const SkinContext& skin) {
    DERMIS_TRY_ASSIGN(const Technique* technique, preintegrated());
    const PassList list =
        technique->build(ParameterValues(technique->parameters), {.skin_gaussians = skin.gaussians});
    std::array<Vec3, 3> weights;
    for (const auto& [name, value] : list.passes.front().values)
        for (size_t i = 0; i < weights.size(); ++i)
            if (name == "occlusion_weight_" + std::to_string(i)) weights[i] = std::get<Vec3>(value);
    return weights;
}

Result<Image> bake_thickness(const Scene& scene) {
    constexpr double kSteps = 1000;
    Progress line("thickness", size_t(kSteps));
    std::atomic<size_t> shown = 0;
    const BakeMapSettings settings = {.kind = MapKind::thickness,
                                      .size = kThicknessSize,
                                      .ray_size = kThicknessSize / 2,
                                      .max_mm = kThicknessMaxMm};
    Result<BakedMap> map = bake_map(scene.objects, settings, [&](double done) {
        const auto now = size_t(done * kSteps);
        const size_t before = shown.exchange(now);
        if (now > before) line.advance(now - before);
    });
    if (!map) return map.error();
    return std::move(map->values);
}

Result<Image> thickness_of(const Scene& scene) {
    if (has_cut_outs(scene.objects)) return bake_thickness(scene);
    Hasher hasher;
    hasher.add(rays_version()).add(kThicknessSize).add(kThicknessMaxMm);
    for (const SceneObject& object : scene.objects) {
        add_shape(hasher, object);
        hasher.add(atlas_uvs_of(object.mesh));
    }
    return cached(
        "thickness", hasher.hex(), Image(kThicknessSize, kThicknessSize, 1),
        [&] { return bake_thickness(scene); }, [](Image& image) { return std::tie(image.bytes); });
}

// Empty where the head cannot have them; the warning says why.
Result<DiffusedNormals> normals_of(const Scene& scene, const GaussianSum& gaussians,
                                   std::vector<std::string>& warnings) {
    std::string fault = unfit_for_baked_maps(scene);
    const Vec3 own = own_normal_weights(gaussians, {});
    if (fault.empty() && (own.x >= 1 || own.x > std::min(own.y, own.z)))
        fault = "red does not scatter farthest in the profile";
    if (!fault.empty()) {
        warnings.push_back("no baked normals: " + fault);
        return DiffusedNormals{};
    }
    return bake_diffused_normals(scene, gaussians, {});
}

}  // namespace

Result<ExportedHead> export_head(const SceneChoice& choice, const std::string& profile_name,
                                 const std::string& engine) {
    DERMIS_TRY_ASSIGN(Scene scene, choice.load());
    if (!profile_name.empty()) scene.skin.profile = profile_name;
    ExportedHead made = {.profile = scene.skin.profile, .inputs = files_of(scene)};
    if (scene.technique == "preintegrated") made.settings = scene.settings;
    DERMIS_TRY_ASSIGN(const Profile profile, find_profile(scene.skin.profile));
    DERMIS_TRY(complete_scene(scene));
    const SkinContext skin = skin_context(profile);
    std::vector<std::string> warnings = scene.warnings;
    DERMIS_TRY_ASSIGN(DiffusedNormals normals, normals_of(scene, skin.gaussians, warnings));
    DERMIS_TRY_ASSIGN(Image thickness_mm, thickness_of(scene));
    DERMIS_TRY_ASSIGN(const auto weights, occlusion_weights(skin));
    DERMIS_TRY_ASSIGN(made.head, make_head({.scene = scene,
                                            .normals = std::move(normals),
                                            .thickness_mm = std::move(thickness_mm),
                                            .occlusion_weights = weights,
                                            .format = head_format(engine)}));
    made.head.warnings.insert(made.head.warnings.begin(), warnings.begin(), warnings.end());
    return made;
}

}  // namespace dermis::cli
