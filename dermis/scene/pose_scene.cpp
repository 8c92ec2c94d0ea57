#include "dermis/scene/pose_scene.h"

#include <algorithm>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/mesh/read_mesh.h"
#include "dermis/mesh/surface_frame.h"
#include "dermis/scene/place_mesh.h"

namespace dermis::inline scene {

bool ScenePoser::can_pose(const SceneObject& object) {
    return !object.motion.empty() && !object.file.empty() &&
           object.mesh.file_vertices.size() == object.mesh.positions_mm.size();
}

Result<ScenePoser> ScenePoser::create(const Scene& scene) {
    ScenePoser poser;
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        const SceneObject& object = scene.objects[i];
        if (!can_pose(object)) continue;
        DERMIS_TRY_ASSIGN(std::vector<std::byte> bytes, read_file(object.file));
        poser.rests_.push_back({.object = i,
                                .file = std::move(bytes),
                                .normals = object.mesh.normals,
                                .directions = surface_directions(object.mesh),
                                .tangents = object.mesh.tangents,
                                .curvatures_per_mm = object.mesh.curvatures_per_mm});
    }
    return poser;
}

Result<void> ScenePoser::pose(const Pose& pose, Scene& scene) const {
    for (const Rest& rest : rests_) {
        SceneObject& object = scene.objects[rest.object];
        const bool is_glb = to_lower(object.file.extension().string()) == ".glb";
        DERMIS_TRY_ASSIGN(LoadedMesh posed,
                          parse_mesh(rest.file, is_glb ? MeshFormat::glb : MeshFormat::gltf, object.file,
                                     [&](const std::string& path) {
                                         return read_file(object.file.parent_path() / utf8_path(path));
                                     },
                                     {.unit_mm = object.unit_mm, .pose = pose, .keep_vertices = true}));
        place_mesh(posed.mesh, object.placement);
        Mesh& mesh = object.mesh;
        const std::vector<uint32_t>& from = mesh.file_vertices;
        if (posed.mesh.positions_mm.size() <= std::ranges::max(from))
            return Error{object.file.string() + ": has fewer vertices than before; open it again"};
        for (size_t v = 0; v < from.size(); ++v) {
            mesh.positions_mm[v] = posed.mesh.positions_mm[from[v]];
            mesh.normals[v] = posed.mesh.normals[from[v]];
        }
        const std::vector<Vec3> directions = surface_directions(mesh);
        for (size_t v = 0; v < from.size(); ++v) {
            const SurfaceFrame before(rest.normals[v], rest.directions[v]),
                after(mesh.normals[v], directions[v]);
            const Vec4 t = rest.tangents[v];
            const Vec3 turned = moved(before, after, Vec3{t.x, t.y, t.z});
            mesh.tangents[v] = {turned.x, turned.y, turned.z, t.w};
            if (!rest.curvatures_per_mm.empty())
                mesh.curvatures_per_mm[v] = moved(before, after, rest.curvatures_per_mm[v]);
        }
    }
    return {};
}

}  // namespace dermis::inline scene
