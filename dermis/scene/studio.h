#pragma once
// The built-in environment: a dark studio with soft boxes, as a function of direction.

#include "dermis/base/vec.h"
#include "dermis/image/image.h"

namespace dermis::inline scene {

/// Linear radiance from a unit direction. A large warm box at the upper left (yaw -50, pitch 35, where the
/// default key light is), a large cool one at the right, two strips behind, one box overhead, and a room
/// that is a little brighter at the horizon.
[[nodiscard]] Vec3 studio_radiance(Vec3 d);

/// The function as a panorama, 4 samples a texel.
[[nodiscard]] Image make_studio_panorama(int width);

}  // namespace dermis::inline scene
