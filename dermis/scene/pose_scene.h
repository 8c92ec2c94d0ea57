#pragma once
// A loaded scene in another pose, without what loading costs: for pictures while a head moves.

#include <cstddef>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/scene/scene.h"

namespace dermis::inline scene {

class ScenePoser {
  public:
    /// Keeps the bytes of the mesh files that move, and the shape that the scene's objects have now. Errors:
    /// a file that cannot be read any more.
    [[nodiscard]] static Result<ScenePoser> create(const Scene& scene);

    /// Whether the scene's object can be posed: its file has motion, and its vertices are those of the file.
    /// Subdivided and displaced meshes cannot; load them in the pose.
    [[nodiscard]] static bool can_pose(const SceneObject& object);

    /// Moves the vertices of `scene`, whose meshes must be those of create(). Positions and normals are those
    /// that loading in the pose gives. Tangents and curvature tensors turn with the surface (dP/du and
    /// normal) from the shape that create() saw; occlusion and bounds stay. Errors: a file that does not fit
    /// any more. Cost: dominated by reading the mesh (docs/figures.md#moving-heads).
    [[nodiscard]] Result<void> pose(const Pose& pose, Scene& scene) const;

  private:
    struct Rest {
        size_t object = 0;
        std::vector<std::byte> file;
        std::vector<Vec3> normals, directions;
        std::vector<Vec4> tangents;
        std::vector<CurvatureTensor> curvatures_per_mm;
    };
    std::vector<Rest> rests_;
};

}  // namespace dermis::inline scene
