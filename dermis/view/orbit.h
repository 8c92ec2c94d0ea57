#pragma once
// Camera and key light under the mouse. Pixels go right and down; `height_px` is the picture's.

#include "dermis/scene/scene.h"

namespace dermis::view {

/// The eye around the target: a drag over the picture's height is half a turn. The pitch stops short of the
/// poles.
void orbit(Camera& camera, Vec2 drag_px, float height_px);
/// Eye and target together, so that the target's plane follows the mouse.
void pan(Camera& camera, Vec2 drag_px, float height_px);
/// Closer by a tenth each notch, between a hundredth of and fifty times the scene's radius.
void zoom(Camera& camera, float notches, float radius_mm);
/// Looks at the whole scene from the present direction; `aspect` is width over height.
void fit(Camera& camera, const Scene& scene, float aspect);
/// The key light around the scene's middle; what faces the eye follows the mouse.
void turn_key_light(Scene& scene, Vec2 drag_px, float height_px);

}  // namespace dermis::view
