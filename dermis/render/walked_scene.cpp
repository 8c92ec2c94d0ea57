#include "dermis/render/walked_scene.h"

#include "dermis/base/hash.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"
#include "dermis/rays/vertex_gain.h"
#include "dermis/scene/skin_profiles.h"

namespace dermis::inline render {
namespace {

const std::vector<SceneObject>& walked_objects(const Scene& scene) {
    return scene.rest_bakes.gain ? scene.rest_objects : scene.objects;
}

// Calls take(object, vertex) for the vertices whose materials have this profile, some of them several times.
template <class Take>
void for_vertices_of(const Scene& scene, size_t profile, const Take& take) {
    const std::vector<std::string> names = skin_profiles(scene);
    for (size_t o = 0; o < scene.objects.size(); ++o) {
        const Mesh& mesh = scene.objects[o].mesh;
        for (const Submesh& submesh : mesh.submeshes) {
            if (profile_index(scene, names, scene.objects[o], submesh.material) != profile) continue;
            for (uint32_t i = submesh.first_index; i < submesh.first_index + submesh.index_count; ++i)
                take(o, mesh.indices[i]);
        }
    }
}

}  // namespace

std::string walks_key(const Scene& scene, Gain gain) {
    Hasher hasher;
    hasher.add(gain);
    const std::vector<std::string> names = skin_profiles(scene);
    for (const std::string& name : names) hasher.add(name);
    for (const SceneObject& object : scene.objects) {
        for (const Submesh& submesh : object.mesh.submeshes)
            hasher.add(profile_index(scene, names, object, submesh.material));
        hasher.add(object.classes);
    }
    return hasher.hex();
}

Result<std::vector<std::vector<Vec3>>> walk_scene_gains(const Scene& scene) {
    std::vector<std::vector<Vec3>> gains;
    const std::vector<std::string> profiles = skin_profiles(scene);
    for (size_t p = 0; p < profiles.size(); ++p) {
        DERMIS_TRY_ASSIGN(const Profile profile, find_profile(profiles[p]));
        DERMIS_TRY_ASSIGN(VertexGains walked,
                          walk_vertex_gains(walked_objects(scene), walk_medium_of(profile)));
        if (p == 0) {
            gains = std::move(walked.gains);
            continue;
        }
        for_vertices_of(scene, p, [&](size_t o, uint32_t v) { gains[o][v] = walked.gains[o][v]; });
    }
    return gains;
}

Result<VertexLinks> walk_scene_links(const Scene& scene) {
    VertexLinks links;
    const std::vector<std::string> profiles = skin_profiles(scene);
    for (size_t p = 0; p < profiles.size(); ++p) {
        DERMIS_TRY_ASSIGN(const Profile profile, find_profile(profiles[p]));
        DERMIS_TRY_ASSIGN(
            VertexLinks walked,
            walk_vertex_links(walked_objects(scene), walk_medium_of(profile), to_gaussian_sum(profile).sum));
        if (p == 0) {
            links = std::move(walked);
            continue;
        }
        // Its rows follow those of the profiles before.
        const auto rows = uint32_t(links.first.size() - 1), before = uint32_t(links.links.size());
        for (size_t r = 2; r < walked.first.size(); ++r) links.first.push_back(before + walked.first[r]);
        links.links.insert(links.links.end(), walked.links.begin(), walked.links.end());
        for_vertices_of(scene, p, [&](size_t o, uint32_t v) {
            const uint32_t row = walked.rows[o][v];
            links.rows[o][v] = row == 0 ? 0 : rows + row - 1;
        });
    }
    return links;
}

}  // namespace dermis::inline render
