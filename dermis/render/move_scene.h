#pragma once
// The frames of a clip from one scene and one renderer.

#include "dermis/render/renderer.h"

namespace dermis::inline render {

/// Moves a complete scene of load_scene() to another time of its clip, and its renderer with it: pictures are
/// those of a scene that is loaded there, to the byte, with the camera and the lights of this one. Maps,
/// environment, pipelines, tables and the atlas stay. Errors: those of move_objects() and complete_scene();
/// bakes of the rest pose where the vertices of the pose are others.
[[nodiscard]] Result<void> move_scene(double time_s, Scene& scene, Renderer& renderer);

}  // namespace dermis::inline render
