#include "dermis/scene/rig_scene.h"

#include <array>
#include <cmath>
#include <numeric>

#include "dermis/base/file.h"
#include "dermis/scene/place_mesh.h"
#include "dermis/scene/pose_scene.h"

namespace dermis::inline scene {
namespace {

using Quaternion = std::array<double, 4>;  // x y z w

Quaternion product(const Quaternion& a, const Quaternion& b) {
    return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
            a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
            a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
            a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

RigNode root_of(const SceneObject& object) {
    const Placement& at = object.placement;
    const auto about = [](size_t axis, float angle_rad) {
        Quaternion turn = {0, 0, 0, std::cos(0.5 * double(angle_rad))};
        turn[axis] = std::sin(0.5 * double(angle_rad));
        return turn;
    };
    const double scale = double(at.scale) * object.unit_mm / 1000;
    const Vec3 to = at.translation_mm;
    return {.name = object.name,
            .translation = {double(to.x) / 1000, double(to.y) / 1000, double(to.z) / 1000},
            .scale = {scale, scale, scale},
            .rotation = product(about(2, at.rotation_rad.z),
                                product(about(1, at.rotation_rad.y), about(0, at.rotation_rad.x)))};
}

// Before the placement; both are unit.
Vec4 unplaced(Vec4 tangent, const Placement& placement) {
    Mesh axes;
    axes.normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    place_mesh(axes, placement);
    const Vec3 t = {tangent.x, tangent.y, tangent.z};
    return {dot(axes.normals[0], t), dot(axes.normals[1], t), dot(axes.normals[2], t), tangent.w};
}

// The subject's own positions and normals, and the changes of every target.
void take_shapes(const SceneObject& object, RigPart& part) {
    const std::vector<uint32_t>& numbers = object.mesh.file_vertices;
    const auto rest = object.posed_vertices({});
    for (size_t v = 0; v < part.vertices.size(); ++v) {
        const uint32_t from = numbers[part.vertices[v]];
        part.mesh.positions_mm[v] = rest.positions_mm[from];
        part.mesh.normals[v] = rest.normals[from];
    }
    for (Vec4& tangent : part.mesh.tangents) tangent = unplaced(tangent, object.placement);
    for (const std::string& name : object.motion.targets) {
        const PosedVertices moved = object.posed_vertices({.morph = {{name, 1.0f}}});
        RigTarget& target = part.targets.emplace_back();
        target.name = name;
        for (const uint32_t v : part.vertices) {
            target.moves_mm.push_back(moved.positions_mm[numbers[v]] - rest.positions_mm[numbers[v]]);
            target.turns.push_back(moved.normals[numbers[v]] - rest.normals[numbers[v]]);
        }
    }
}

// A subject's vertices have one node.
Rig rig_of_subject(const SceneObject& object, const Pose& pose) {
    Rig rig;
    rig.nodes = {root_of(object), {.name = object.name}};
    rig.nodes[0].children = {1};
    rig.nodes[0].scale.fill(double(object.placement.scale));
    std::vector<size_t> all(object.mesh.submeshes.size());
    std::iota(all.begin(), all.end(), size_t(0));
    RigPart part = part_of(object.mesh, all);
    part.node = 1;
    take_shapes(object, part);
    const TargetWeights weights = pose.empty() ? TargetWeights{} : object.posed_vertices(pose).target_weights;
    for (const RigTarget& target : part.targets) {
        const auto found = weights.find(target.name);
        part.target_weights.push_back(found == weights.end() ? 0 : found->second);
    }
    for (const ClipInfo& clip : object.motion.clips)
        rig.clips.push_back({clip.name,
                             {{1,
                               "weights",
                               {.interpolation = gltf::Interpolation::cubic_spline,
                                .width = part.targets.size(),
                                .times_s = clip.weights.times_s,
                                .values = clip.weights.values}}}});
    rig.parts.push_back(std::move(part));
    return rig;
}

}  // namespace

Result<std::optional<Rig>> rig_of(const SceneObject& object, const Pose& pose) {
    if (!ScenePoser::can_pose(object)) return std::optional<Rig>();
    if (object.posed_vertices) return std::optional(rig_of_subject(object, pose));
    DERMIS_TRY_ASSIGN(const std::vector<std::byte> file, read_file(object.file));
    const ReadSibling read_sibling = [&](const std::string& path) {
        return read_file(object.file.parent_path() / utf8_path(path));
    };
    DERMIS_TRY_ASSIGN(Rig rig, read_rig(file, object.file, read_sibling, object.mesh, pose, root_of(object)));
    return std::optional(std::move(rig));
}

}  // namespace dermis::inline scene
