#pragma once
// What shading needs and files do not have: the curvature of the skin at each vertex, and the occlusion of
// the environment there.

#include "dermis/base/result.h"
#include "dermis/scene/scene.h"

namespace dermis {

/// Fills Mesh::curvatures_per_mm with its tensors, averaged over kCurvatureSmoothingMm, and Mesh::occlusions
/// of every object that lacks them, occluded by all opaque ones; cached by content, so that a second start
/// costs a file read.
[[nodiscard]] Result<void> complete_scene(Scene& scene);

}  // namespace dermis
