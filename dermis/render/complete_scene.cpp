#include "dermis/render/complete_scene.h"

#include <algorithm>
#include <cstring>

#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
#include "dermis/mesh/curvature.h"
#include "dermis/rays/vertex_occlusion.h"

namespace dermis {
namespace {

std::string curvature_hash(const Mesh& mesh) {
    Hasher hasher;
    hasher.add("curvature 1").add(kCurvatureSmoothingMm);
    hasher.add(std::as_bytes(std::span(mesh.positions_mm)));
    hasher.add(std::as_bytes(std::span(mesh.normals)));
    hasher.add(std::as_bytes(std::span(mesh.indices)));
    return hasher.hex();
}

Result<std::vector<float>> cached_curvature(const Mesh& mesh) {
    const size_t count = mesh.positions_mm.size();
    const Result<std::vector<std::byte>> bytes = cached(
        "curvature", curvature_hash(mesh), count * sizeof(float), [&]() -> Result<std::vector<std::byte>> {
            const std::vector<float> curvatures = compute_curvature(mesh, kCurvatureSmoothingMm);
            const auto view = std::as_bytes(std::span(curvatures));
            return std::vector<std::byte>(view.begin(), view.end());
        });
    if (!bytes) return bytes.error();
    std::vector<float> curvatures(count);
    std::memcpy(curvatures.data(), bytes->data(), bytes->size());
    return curvatures;
}

bool has_occlusion(const SceneObject& object) {
    return object.mesh.occlusions.size() == object.mesh.positions_mm.size();
}

}  // namespace

Result<void> complete_scene(Scene& scene) {
    for (SceneObject& object : scene.objects) {
        if (object.mesh.curvatures_per_mm.size() == object.mesh.positions_mm.size()) continue;
        Result<std::vector<float>> curvatures = cached_curvature(object.mesh);
        if (!curvatures) return curvatures.error();
        object.mesh.curvatures_per_mm = std::move(*curvatures);
    }
    if (std::ranges::all_of(scene.objects, has_occlusion)) return {};
    Result<std::vector<std::vector<float>>> occlusions = compute_vertex_occlusion(scene.objects);
    if (!occlusions) return occlusions.error();
    for (size_t i = 0; i < scene.objects.size(); ++i)
        if (!has_occlusion(scene.objects[i])) scene.objects[i].mesh.occlusions = std::move((*occlusions)[i]);
    return {};
}

}  // namespace dermis
