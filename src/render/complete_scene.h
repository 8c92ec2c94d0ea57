#pragma once
// What shading wants and files do not have: how much of its surroundings each vertex sees.

#include "dermis/base/result.h"
#include "dermis/scene/scene.h"

namespace dermis {

/// Fills Mesh::occlusions of every object, occluded by all opaque ones; cached by content, so a second start
/// costs a file read (cold: about 7 million rays a second on two cores). Meshes that have them keep them.
[[nodiscard]] Result<void> complete_scene(Scene& scene);

}  // namespace dermis
