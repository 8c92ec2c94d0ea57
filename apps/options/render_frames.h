#pragma once
// Frames of `dermis render`: of one pose or of a clip, with a camera that may turn.

#include "render_options.h"

namespace dermis::cli {

inline constexpr NumberRange kTurnRangeDeg = {-1e6, 1e6};

struct RenderFrames {
    int count = 1;
    double fps = 0;       ///< of the clip; 0: the pose stays
    double turn_deg = 0;  ///< of the camera over all frames
};

/// Turns the eye about the target's vertical and fits the depth range.
void turn_camera(Scene& scene, const Camera& start, double angle_rad);

/// Moves the scene and its renderer to a frame. `start`: the scene as it was prepared, without_objects().
/// Errors: those of move_scene().
[[nodiscard]] Result<void> show_frame(const RenderFrames& frames, int frame, const Scene& start, Scene& scene,
                                      Renderer& renderer);

}  // namespace dermis::cli
