#include "dermis/render/complete_scene.h"

#include <algorithm>

#include "dermis/reference/vertex_occlusion.h"

namespace dermis {

Result<void> complete_scene(Scene& scene) {
    const auto complete = [](const SceneObject& object) {
        return object.mesh.occlusions.size() == object.mesh.positions_mm.size();
    };
    if (std::ranges::all_of(scene.objects, complete)) return {};
    Result<std::vector<std::vector<float>>> occlusions = compute_vertex_occlusion(scene.objects);
    if (!occlusions) return occlusions.error();
    for (size_t i = 0; i < scene.objects.size(); ++i)
        if (!complete(scene.objects[i])) scene.objects[i].mesh.occlusions = std::move((*occlusions)[i]);
    return {};
}

}  // namespace dermis
