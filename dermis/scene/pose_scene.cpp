#include "dermis/scene/pose_scene.h"

#include <algorithm>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/mesh/read_mesh.h"
#include "dermis/mesh/uv_report.h"
#include "dermis/scene/place_mesh.h"

namespace dermis::inline scene {
namespace {

// A direction on the surface at each vertex that moves with it: dP/du, or an edge where the UVs have no area.
std::vector<Vec3> surface_directions(const Mesh& mesh) {
    std::vector<Vec3> directions(mesh.positions_mm.size());
    if (mesh.uvs.size() == mesh.positions_mm.size()) directions = vertex_uv_derivatives(mesh).du_mm;
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        const uint32_t v = mesh.indices[i], next = mesh.indices[i % 3 == 2 ? i - 2 : i + 1];
        if (directions[v] == Vec3{}) directions[v] = mesh.positions_mm[next] - mesh.positions_mm[v];
    }
    return directions;
}

// The frame of a normal and a direction beside it.
struct SurfaceFrame {
    Vec3 t, b, n;

    SurfaceFrame(Vec3 normal, Vec3 direction)
        : t(normalize(direction - normal * dot(normal, direction))), b(cross(normal, t)), n(normal) {}
};

Vec3 moved(const SurfaceFrame& from, const SurfaceFrame& to, Vec3 v) {
    return to.t * dot(from.t, v) + to.b * dot(from.b, v) + to.n * dot(from.n, v);
}

// R S R^T.
CurvatureTensor moved(const SurfaceFrame& from, const SurfaceFrame& to, const CurvatureTensor& s) {
    const auto column = [&](Vec3 axis) { return moved(from, to, s * moved(to, from, axis)); };
    const Vec3 x = column({1, 0, 0}), y = column({0, 1, 0}), z = column({0, 0, 1});
    return {{x.x, y.y, z.z}, {z.y, z.x, y.x}};
}

}  // namespace

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
