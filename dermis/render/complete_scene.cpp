#include "dermis/render/complete_scene.h"

#include <algorithm>

#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
#include "dermis/base/progress.h"
#include "dermis/mesh/blur_vertices.h"
#include "dermis/mesh/curvature.h"
#include "dermis/rays/vertex_occlusion.h"
#include "dermis/scene/scene_hash.h"
#include "dermis/scene/skin_atlas.h"
#include "shaders/include/constants.h"

namespace dermis::inline render {
namespace {

bool has_occlusion(const SceneObject& object) {
    return object.mesh.occlusions.size() == object.mesh.positions_mm.size();
}

Result<void> complete_objects(std::vector<SceneObject>& objects) {
    Progress progress("curvature", objects.size());
    for (SceneObject& object : objects) {
        if (object.mesh.curvatures_per_mm.size() != object.mesh.positions_mm.size()) {
            DERMIS_TRY_ASSIGN(object.mesh.curvatures_per_mm, cached_curvature(object));
        }
        progress.advance();
    }
    if (std::ranges::all_of(objects, has_occlusion)) return {};
    Result<std::vector<std::vector<float>>> occlusions = compute_vertex_occlusion(objects);
    if (!occlusions) return occlusions.error();
    for (size_t i = 0; i < objects.size(); ++i)
        if (!has_occlusion(objects[i])) objects[i].mesh.occlusions = std::move((*occlusions)[i]);
    return {};
}

}  // namespace

Result<std::vector<CurvatureTensor>> cached_curvature(const SceneObject& object) {
    Hasher hasher;
    add_shape(hasher.add("curvature 3").add(kCurvatureSmoothingMm), object);
    return cached("curvature", hasher.hex(), std::vector<CurvatureTensor>(object.mesh.positions_mm.size()),
                  [&] { return Result(compute_curvature_tensors(object.mesh, kCurvatureSmoothingMm)); });
}

Result<void> complete_scene(Scene& scene) {
    DERMIS_TRY(complete_objects(scene.objects));
    DERMIS_TRY(complete_objects(scene.rest_objects));
    lay_out_skin_atlas(scene);
    return {};
}

Result<std::vector<Vec3>> blurred_occlusions(const Mesh& mesh) {
    std::vector<float> occlusions = mesh.occlusions;
    occlusions.resize(mesh.positions_mm.size(), 1.0f);
    // Nothing occludes: nothing to blur.
    if (std::ranges::all_of(occlusions, [&](float occlusion) { return occlusion == occlusions.front(); }))
        return std::vector(occlusions.size(), Vec3{1, 1, 1} * (occlusions.empty() ? 1 : occlusions.front()));
    const std::vector<double> variances_mm2 = {kOcclusionVariance0Mm2, kOcclusionVariance1Mm2,
                                               kOcclusionVariance2Mm2};
    Hasher hasher;
    hasher.add("blurred occlusion 1").add(variances_mm2);
    hasher.add(mesh.positions_mm).add(mesh.indices).add(occlusions);
    return cached("blurred_occlusion", hasher.hex(), std::vector<Vec3>(occlusions.size()),
                  [&]() -> Result<std::vector<Vec3>> {
                      DERMIS_TRY_ASSIGN(const std::vector<std::vector<float>> blurred,
                                        blur_over_surface(mesh, occlusions, variances_mm2));
                      std::vector<Vec3> made;
                      for (size_t i = 0; i < occlusions.size(); ++i)
                          made.push_back({blurred[0][i], blurred[1][i], blurred[2][i]});
                      return made;
                  });
}

}  // namespace dermis::inline render
