#include "dermis/scene/move_objects.h"

#include <algorithm>
#include <utility>

#include "dermis/mesh/read_mesh.h"
#include "dermis/scene/blood_tint.h"
#include "dermis/scene/place_mesh.h"
#include "dermis/scene/placement.h"
#include "dermis/scene/pose_scene.h"

namespace dermis::inline scene {
namespace {

// The positions at rest of `moved`, in the scene, from those of the object in its pose before. False where
// its vertices are not those of the file, or where that pose had other ones.
bool take_rest_positions(const SceneObject& before, Mesh& moved) {
    const Mesh& mesh = before.mesh;
    if (mesh.rest_positions_mm.empty() || mesh.file_vertices.empty() || moved.file_vertices.empty())
        return false;
    const uint32_t count =
        1 + std::max(std::ranges::max(mesh.file_vertices), std::ranges::max(moved.file_vertices));
    std::vector<Vec3> by_file_vertex(count);
    std::vector<bool> known(count);
    for (size_t v = 0; v < mesh.file_vertices.size(); ++v) {
        by_file_vertex[mesh.file_vertices[v]] = mesh.rest_positions_mm[v];
        known[mesh.file_vertices[v]] = true;
    }
    for (const uint32_t vertex : moved.file_vertices)
        if (!known[vertex]) return false;
    for (const uint32_t vertex : moved.file_vertices)
        moved.rest_positions_mm.push_back(by_file_vertex[vertex]);
    return true;
}

// Placed.
Result<void> read_in_pose(const Pose& pose, SceneObject& object) {
    const MeshOptions options = {.unit_mm = object.unit_mm,
                                 .scale_after = double(object.placement.scale),
                                 .subdivision_level = object.subdivision,
                                 .ignore_missing_materials = true,
                                 .pose = pose};
    DERMIS_TRY_ASSIGN(LoadedMesh loaded, read_mesh(object.file, options));
    if (loaded.mesh.materials.size() != object.mesh.materials.size())
        return Error{object.file.string() + ": has other materials than before; open it again"};
    std::vector<Vec3> rest_mm;
    if (take_rest_positions(object, loaded.mesh))
        rest_mm = std::exchange(loaded.mesh.rest_positions_mm, {});
    else
        DERMIS_TRY(add_rest_positions(object.file, options, loaded));
    place_mesh(loaded.mesh, object.placement);
    if (!rest_mm.empty()) loaded.mesh.rest_positions_mm = std::move(rest_mm);
    loaded.mesh.materials = std::move(object.mesh.materials);
    object.mesh = std::move(loaded.mesh);
    object.target_weights = std::move(loaded.target_weights);
    measure_tension(object.mesh);
    return {};
}

void make_in_pose(const Pose& pose, SceneObject& object) {
    Mesh at_rest = *object.made;
    at_rest.materials = std::move(object.mesh.materials);
    object.mesh = std::move(at_rest);
    pose_subject(object, pose);
    place_mesh(object.mesh, object.placement);
}

}  // namespace

Result<void> move_objects(Scene& scene) {
    DERMIS_TRY(check_motion(scene.objects, scene.motion));
    const Pose pose = scene.motion.pose();
    for (SceneObject& object : scene.objects) {
        object.mesh.occlusions.clear();  // other objects may occlude it
        if (object.motion.empty()) continue;
        if (object.made)
            make_in_pose(pose, object);
        else
            DERMIS_TRY(read_in_pose(pose, object));
        DERMIS_TRY(apply_displacement(object.mesh));
        if (!object.hidden.empty()) hide_materials(object.mesh, object.hidden);
        object.blood_by_target.clear();
    }
    compute_bounds(scene);
    for (const auto& [target, map] : scene.skin.blood_by_target)
        DERMIS_TRY(add_blood_by_target(target, map, scene));
    return apply_moving_blood(scene);
}

}  // namespace dermis::inline scene
