#include "dermis/rays/vertex_occlusion.h"

#include <algorithm>
#include <bit>

#include "dermis/base/cache.h"
#include "dermis/base/hash.h"
#include "dermis/base/parallel.h"
#include "dermis/base/progress.h"
#include "dermis/rays/random.h"
#include "dermis/rays/rays_version.h"
#include "dermis/rays/sampling.h"
#include "dermis/scene/scene_hash.h"

namespace dermis::inline rays {
namespace {

// Equal for vertices that differ only by a UV seam.
uint32_t seed_of(Vec3 p_mm, Vec3 n) {
    uint32_t seed = 0;
    for (const float value : {p_mm.x, p_mm.y, p_mm.z, n.x, n.y, n.z})
        seed = hash_u32(seed, std::bit_cast<uint32_t>(value));
    return seed;
}

std::vector<float> mesh_occlusion(const RayScene& scene, const Mesh& mesh, const OcclusionSettings& settings,
                                  Progress& progress) {
    std::vector<float> occlusion(mesh.positions_mm.size(), 1.0f);
    if (mesh.normals.size() != occlusion.size()) return occlusion;
    parallel_for(occlusion.size(), 256, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const Vec3 p_mm = mesh.positions_mm[i], n = mesh.normals[i];
            if (dot(n, n) > 0.5f) occlusion[i] = point_occlusion(scene, p_mm, n, seed_of(p_mm, n), settings);
        }
        progress.advance(end - begin);
    });
    return occlusion;
}

std::vector<std::vector<float>> occlusion_of(const RayScene& scene, std::span<const SceneObject> objects,
                                             const OcclusionSettings& settings) {
    size_t vertices = 0;
    for (const SceneObject& object : objects) vertices += object.mesh.positions_mm.size();
    Progress progress("occlusion at the vertices", vertices);
    std::vector<std::vector<float>> values;
    for (const SceneObject& object : objects)
        values.push_back(mesh_occlusion(scene, object.mesh, settings, progress));
    return values;
}

}  // namespace

float point_occlusion(const RayScene& scene, Vec3 p_mm, Vec3 n, uint32_t seed,
                      const OcclusionSettings& settings) {
    const LocalFrame frame = frame_of(n);
    const float offset_mm = 10 * scene.epsilon_mm();
    int open = 0;
    for (int i = 0; i < settings.rays; ++i) {
        const Vec3 direction =
            frame.to_world(sample_cosine_hemisphere(OwenSequence(seed, uint32_t(i)).next_2d()));
        open += !scene.occluded(RaySet::opaque, {.origin_mm = p_mm + n * offset_mm,
                                                 .direction = direction,
                                                 .min_mm = offset_mm,
                                                 .max_mm = settings.max_mm});
    }
    return float(open) / float(settings.rays);
}

Result<std::vector<std::vector<float>>> compute_vertex_occlusion(std::span<const SceneObject> objects,
                                                                 const OcclusionSettings& settings) {
    if (settings.rays < 1 || settings.rays > 65536)
        return Error{"occlusion rays: " + std::to_string(settings.rays) + " is outside 1..65536"};
    const auto make = [&]() -> Result<std::vector<std::vector<float>>> {
        DERMIS_TRY_ASSIGN(const RayScene scene, RayScene::build(objects));
        return occlusion_of(scene, objects, settings);
    };
    if (!settings.use_cache || has_cut_outs(objects)) return make();
    Hasher hasher;
    hasher.add(rays_version()).add(settings.rays).add(settings.max_mm);
    std::vector<std::vector<float>> blank;
    for (const SceneObject& object : objects) {
        add_shape(hasher, object);
        blank.emplace_back(object.mesh.positions_mm.size());
    }
    return cached("occlusion", hasher.hex(), std::move(blank), make);
}

Result<std::vector<float>> compute_vertex_occlusion(const Mesh& mesh, const OcclusionSettings& settings) {
    const SceneObject object{.name = {}, .mesh = mesh, .classes = {}};
    DERMIS_TRY_ASSIGN(std::vector<std::vector<float>> values,
                      compute_vertex_occlusion(std::span(&object, 1), settings));
    return std::move(values[0]);
}

}  // namespace dermis::inline rays
