#pragma once
// The parts of a scene that can change after loading: lights, camera, environment, skin,
// exposure and tone map. A description places them; describe() is its inverse.

#include "dermis/scene/scene_description.h"

namespace dermis::inline scene {

/// Lights, camera, environment, skin and the keys of the root, into a scene whose objects and bounds are
/// there. Without any light or environment the studio's are taken. Errors: a panorama or a table that is not
/// there, with its place.
[[nodiscard]] Result<void> place_views(const SceneDescription& description, Scene& scene);

/// One light and the camera, around the middle of the scene where the description names no target.
[[nodiscard]] Light place_light(const LightDescription& given, Vec3 center_mm);
[[nodiscard]] Camera place_camera(const CameraDescription& given, Vec3 center_mm, float radius_mm);

/// The description of what place_views() placed, without meshes and maps. Camera and lights are given by yaw,
/// pitch and distance around their target; the target of a light is the middle of the scene.
[[nodiscard]] SceneDescription describe(const Scene& scene);
[[nodiscard]] LightDescription describe(const Light& light, Vec3 center_mm);
[[nodiscard]] CameraDescription describe(const Camera& camera);

}  // namespace dermis::inline scene
