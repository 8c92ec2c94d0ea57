#pragma once
// A loaded scene in another pose, as loading it there gives it.

#include "dermis/base/result.h"
#include "dermis/scene/scene.h"

namespace dermis::inline scene {

/// Moves the objects of a scene of load_scene() to the pose of scene.motion: vertices, tangents, tensions,
/// colours, weights and bounds are what load_scene() gives in that pose, to the bit. Materials with their
/// maps, classes, environment, lights, camera and rest_objects stay; only the mesh files are read again.
/// Curvature, occlusion and atlas_uvs are empty afterwards (complete_scene() fills them). Poses of a mesh
/// that is looked at while it moves: ScenePoser. Errors: check_motion(), a file that has changed.
[[nodiscard]] Result<void> move_objects(Scene& scene);

}  // namespace dermis::inline scene
