#pragma once
// A loaded scene in another pose, without what loading costs: for pictures while a head moves.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/mesh/curvature_stencils.h"
#include "dermis/mesh/mesh_poser.h"
#include "dermis/mesh/read_mesh.h"
#include "dermis/mesh/tension.h"
#include "dermis/scene/blood_tint.h"
#include "dermis/scene/rest_bakes.h"
#include "dermis/scene/scene.h"

namespace dermis::inline scene {

/// A clip or a target that none of the objects has is an error, which names what there is.
[[nodiscard]] Result<void> check_motion(std::span<const SceneObject> objects,
                                        const MotionDescription& motion);

/// Length of the scene's clip in the scene's time: at animation.speed. 0 without a clip.
[[nodiscard]] double clip_length_s(const Scene& scene);

/// Of animation.rest_bakes; none where the key is not given. Errors: those of parse_rest_bakes(text).
[[nodiscard]] Result<RestBakes> parse_rest_bakes(const MotionDescription& motion);

/// Fills Mesh::rest_positions_mm of a mesh that was read with `options`, if they have a pose and the file
/// moves. A subdivided mesh whose triangles differ at rest gets a warning instead. Errors: the file.
[[nodiscard]] Result<void> add_rest_positions(const std::filesystem::path& file, MeshOptions options,
                                              LoadedMesh& posed);

/// Fills the tensions of a mesh whose rest_positions_mm are known; others stay as they are.
void measure_tension(Mesh& mesh);

/// Poses an object that code made (SceneObject::posed_vertices), which is at rest; others and an empty pose
/// change nothing. Tangents turn with the surface; tensions are measured; SceneObject::made keeps the mesh.
void pose_subject(SceneObject& object, const Pose& pose);

/// The directions and tensors of an object's vertices in one pose; they turn when the surface turns.
struct SurfaceAtRest {
    std::vector<Vec3> normals, directions;  ///< directions: dP/du, or along an edge
    std::vector<Vec4> tangents;
    CurvatureAtRest curvature;
};

class ScenePoser {
  public:
    /// Reads the mesh files that move, and keeps the shape that the scene's objects have now. Errors: a file
    /// that cannot be read any more.
    [[nodiscard]] static Result<ScenePoser> create(const Scene& scene);

    /// Whether the scene's object can be posed: it has motion, and its vertices are those of its file or
    /// subject. Subdivided and displaced meshes cannot; load them in the pose.
    [[nodiscard]] static bool can_pose(const SceneObject& object);

    /// Moves the vertices of `scene`, whose meshes must be those of create(). Positions and normals are those
    /// that loading in the pose gives. Tangents turn with the surface (dP/du and normal) from the shape that
    /// create() saw, curvature follows as CurvatureAtRest says; tensions are against the
    /// rest pose, and colours follow them; occlusion and bounds stay. Errors: a file that does not fit any
    /// more. Not for several threads at once. Cost: docs/figures.md#moving-heads.
    [[nodiscard]] Result<void> pose(const Pose& pose, Scene& scene) const;

    struct Posed {
        size_t object = 0;
        std::optional<MeshPoser> file;  ///< none for subjects
        SurfaceAtRest rest;
        RestAreas areas;
        std::vector<Vec4> untinted;
    };
    /// The objects that it poses.
    [[nodiscard]] std::span<const Posed> all() const { return all_; }
    /// Whether their colours follow the pose.
    [[nodiscard]] bool moves_colors() const { return tint_.has_value(); }

  private:
    std::vector<Posed> all_;
    std::optional<BloodTint> tint_;
};

}  // namespace dermis::inline scene
