#include "dermis/scene/pose_scene.h"

#include <algorithm>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/mesh/curvature.h"
#include "dermis/mesh/read_mesh.h"
#include "dermis/mesh/surface_frame.h"
#include "dermis/scene/place_mesh.h"

namespace dermis::inline scene {
namespace {

SurfaceAtRest at_rest(const Mesh& mesh) {
    return {.normals = mesh.normals,
            .directions = surface_directions(mesh),
            .tangents = mesh.tangents,
            .curvature = CurvatureAtRest(mesh, kCurvatureSmoothingMm)};
}

void move_vertices(Mesh& mesh, const PosedVertices& posed, const SurfaceAtRest& rest) {
    const std::vector<uint32_t>& from = mesh.file_vertices;
    for (size_t v = 0; v < from.size(); ++v) {
        mesh.positions_mm[v] = posed.positions_mm[from[v]];
        mesh.normals[v] = posed.normals[from[v]];
    }
    const std::vector<Vec3> directions = surface_directions(mesh);
    for (uint32_t v = 0; v < from.size(); ++v) {
        const SurfaceFrame before(rest.normals[v], rest.directions[v]), after(mesh.normals[v], directions[v]);
        if (!rest.tangents.empty()) {
            const Vec4 t = rest.tangents[v];
            const Vec3 turned = moved(before, after, Vec3{t.x, t.y, t.z});
            mesh.tangents[v] = {turned.x, turned.y, turned.z, t.w};
        }
        if (!rest.curvature.tensors_per_mm.empty())
            mesh.curvatures_per_mm[v] = rest.curvature.posed(v, before, after, mesh.positions_mm);
    }
}

Result<MeshPoser> open_file(const std::filesystem::path& file, double unit_mm) {
    DERMIS_TRY_ASSIGN(const std::vector<std::byte> bytes, read_file(file));
    const ReadSibling read_sibling = [&](const std::string& path) {
        return read_file(file.parent_path() / utf8_path(path));
    };
    return MeshPoser::create(bytes, file, read_sibling, {.unit_mm = unit_mm});
}

Error changed_file(const std::filesystem::path& file) {
    return Error{file.string() + ": has other vertices than before; open it again"};
}

// `positions_mm` count the file's vertices.
Result<std::vector<Vec3>> positions_of(const Mesh& mesh, std::span<const Vec3> positions_mm,
                                       const std::filesystem::path& file) {
    if (!mesh.file_vertices.empty() && positions_mm.size() <= std::ranges::max(mesh.file_vertices))
        return changed_file(file);
    std::vector<Vec3> of_mesh;
    for (const uint32_t from : mesh.file_vertices) of_mesh.push_back(positions_mm[from]);
    return of_mesh;
}

// In the scene.
Result<PosedVertices> vertices_of(const SceneObject& object, const std::optional<MeshPoser>& file,
                                  const Pose& pose) {
    PosedVertices vertices;
    if (file) {
        DERMIS_TRY_ASSIGN(vertices, file->pose(pose));
    } else {
        vertices = object.posed_vertices(pose);
    }
    Mesh mesh{.positions_mm = std::move(vertices.positions_mm), .normals = std::move(vertices.normals)};
    place_mesh(mesh, object.placement);
    if (mesh.positions_mm.size() <= std::ranges::max(object.mesh.file_vertices))
        return changed_file(object.file);
    return PosedVertices{std::move(mesh.positions_mm), std::move(mesh.normals),
                         std::move(vertices.target_weights)};
}

// Areas at rest. The object itself may be in any pose.
Result<RestAreas> areas_at_rest(const SceneObject& object, const std::optional<MeshPoser>& file) {
    DERMIS_TRY_ASSIGN(const PosedVertices vertices, vertices_of(object, file, {}));
    DERMIS_TRY_ASSIGN(const std::vector<Vec3> rest_mm,
                      positions_of(object.mesh, vertices.positions_mm, object.file));
    return rest_areas(rest_mm, object.mesh.indices);
}

}  // namespace

Result<void> check_motion(std::span<const SceneObject> objects, const MotionDescription& motion) {
    if (motion.clip.empty() && motion.time_s != 0)
        return Error{
            "animation.time_s: is the time in a clip; name one with animation.clip or --clip (dermis "
            "info lists them)"};
    if (motion.pose().empty()) return {};
    std::vector<Motion> motions;
    for (const SceneObject& object : objects) motions.push_back(object.motion);
    return check_pose(motion.pose(), motions);
}

double clip_length_s(const Scene& scene) {
    const std::string& name = scene.motion.clip;
    if (name.empty()) return 0;
    double length_s = 0;
    for (const SceneObject& object : scene.objects)
        for (size_t i = 0; i < object.motion.clips.size(); ++i)
            if (const ClipInfo& clip = object.motion.clips[i]; clip.name == name || numbered_name(i) == name)
                length_s = std::max(length_s, clip.length_s);
    return length_s / double(scene.motion.speed);
}

Result<RestBakes> parse_rest_bakes(const MotionDescription& motion) {
    if (motion.rest_bakes.empty()) return RestBakes{};
    const Result<RestBakes> bakes = parse_rest_bakes(motion.rest_bakes);
    return bakes ? bakes : bakes.error().within("animation.rest_bakes");
}

Result<void> add_rest_positions(const std::filesystem::path& file, MeshOptions options, LoadedMesh& posed) {
    if (posed.motion.empty() || options.pose.empty()) return {};
    Mesh& mesh = posed.mesh;
    if (mesh.file_vertices.size() == mesh.positions_mm.size()) {
        DERMIS_TRY_ASSIGN(const MeshPoser poser, open_file(file, posed.unit_mm));
        DERMIS_TRY_ASSIGN(const PosedVertices rest, poser.pose({}));
        DERMIS_TRY_ASSIGN(mesh.rest_positions_mm, positions_of(mesh, rest.positions_mm, file));
        return {};
    }
    options.pose = {};
    options.unit_mm = posed.unit_mm;
    DERMIS_TRY_ASSIGN(LoadedMesh rest, read_mesh(file, options));
    if (rest.mesh.indices == mesh.indices && rest.mesh.positions_mm.size() == mesh.positions_mm.size())
        mesh.rest_positions_mm = std::move(rest.mesh.positions_mm);
    else
        posed.warnings.push_back(file.string() +
                                 ": has other triangles at rest, so that its tension is not known");
    return {};
}

void measure_tension(Mesh& mesh) {
    if (mesh.rest_positions_mm.empty()) return;
    mesh.tensions =
        compute_tensions(rest_areas(mesh.rest_positions_mm, mesh.indices), mesh.positions_mm, mesh.indices);
}

void pose_subject(SceneObject& object, const Pose& pose) {
    if (!object.posed_vertices) return;
    Mesh& mesh = object.mesh;
    if (!object.made) {
        Mesh made = mesh;
        made.materials.clear();
        object.made = std::make_shared<const Mesh>(std::move(made));
    }
    if (pose.empty()) return;
    mesh.rest_positions_mm = mesh.positions_mm;
    PosedVertices vertices = object.posed_vertices(pose);
    move_vertices(mesh, vertices, at_rest(mesh));
    object.target_weights = std::move(vertices.target_weights);
    measure_tension(mesh);
}

bool ScenePoser::can_pose(const SceneObject& object) {
    return !object.motion.empty() && (object.posed_vertices || !object.file.empty()) &&
           object.mesh.file_vertices.size() == object.mesh.positions_mm.size();
}

Result<ScenePoser> ScenePoser::create(const Scene& scene) {
    ScenePoser poser;
    DERMIS_TRY_ASSIGN(poser.tint_, BloodTint::of(scene.skin));
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        const SceneObject& object = scene.objects[i];
        if (!can_pose(object)) continue;
        std::optional<MeshPoser> file;
        if (!object.posed_vertices) {
            DERMIS_TRY_ASSIGN(MeshPoser opened, open_file(object.file, object.unit_mm));
            file = std::move(opened);
        }
        DERMIS_TRY_ASSIGN(RestAreas areas, areas_at_rest(object, file));
        poser.all_.push_back({.object = i,
                              .file = std::move(file),
                              .rest = at_rest(object.mesh),
                              .areas = std::move(areas),
                              .untinted = poser.tint_ ? untinted_colors(object, scene.skin, *poser.tint_)
                                                      : std::vector<Vec4>()});
    }
    return poser;
}

Result<void> ScenePoser::pose(const Pose& pose, Scene& scene) const {
    for (const Posed& posed : all_) {
        SceneObject& object = scene.objects[posed.object];
        DERMIS_TRY_ASSIGN(PosedVertices vertices, vertices_of(object, posed.file, pose));
        Mesh& mesh = object.mesh;
        move_vertices(mesh, vertices, posed.rest);
        mesh.tensions = compute_tensions(posed.areas, mesh.positions_mm, mesh.indices);
        object.target_weights = std::move(vertices.target_weights);
        if (tint_) tint_by_blood(object, scene.skin, *tint_, posed.untinted);
    }
    return {};
}

}  // namespace dermis::inline scene
