#pragma once
// Checks over several keys: keys that exclude one another, and how many there must be.

#include "dermis/scene/scene_description.h"

namespace dermis::inline scene {

/// Also makes a single light the key light.
[[nodiscard]] Result<void> check_scene(SceneDescription& scene);

/// The lights, the environment and the camera alone.
[[nodiscard]] Result<void> check_views(SceneDescription& scene);

/// Keys of [maps] that change nothing, as no material of the scene has the map that they are for; one line
/// each.
[[nodiscard]] std::vector<std::string> keys_without_effect(const SceneDescription& description,
                                                           const Scene& scene);

}  // namespace dermis::inline scene
