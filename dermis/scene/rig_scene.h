#pragma once
// What moves an object of a scene, for files that move as it does.

#include <optional>

#include "dermis/mesh/rig.h"
#include "dermis/scene/scene.h"

namespace dermis::inline scene {

/// Below a root node that has the object's placement, in metres; nodes and weights are in the pose, in which
/// the object is. Nothing for an object without motion, and where ScenePoser::can_pose() says no. Errors: a
/// file that cannot be read any more.
[[nodiscard]] Result<std::optional<Rig>> rig_of(const SceneObject& object, const Pose& pose);

}  // namespace dermis::inline scene
