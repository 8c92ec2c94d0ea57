#pragma once
// Latitude-longitude panoramas: the middle of the picture is -Z, its left and right edges are +Z, the right
// quarter is +X, the top row +Y. Seen from inside, so nothing is mirrored.

#include "dermis/base/vec.h"
#include "dermis/image/image.h"

namespace dermis::inline scene {

/// Unit direction of a point of the picture; u and v in 0..1, v from the top.
[[nodiscard]] Vec3 panorama_direction(float u, float v);
[[nodiscard]] Vec2 panorama_uv(Vec3 d);

/// Bilinear, wrapping around and clamped at the poles; any direction but zero. `panorama` is f32 with 3
/// channels.
[[nodiscard]] Vec3 panorama_radiance(const Image& panorama, Vec3 d);
/// At panorama_uv(d).
[[nodiscard]] Vec3 panorama_radiance(const Image& panorama, Vec2 uv);

/// Solid angle of one texel of a row, steradian.
[[nodiscard]] float panorama_texel_solid_angle(const Image& panorama, int row);

/// f32 with 3 channels; negative values and NaN become 0, infinities kMaxHalf; averaged by whole factors
/// until at most max_width wide.
[[nodiscard]] Image clean_panorama(const Image& linear_float, int max_width);

// The built-in environment: a dark studio with soft boxes, as a function of direction.

/// Linear radiance from a unit direction. A large warm box at the upper left (yaw -50, pitch 35, where the
/// default key light is), a large cool one at the right, two strips behind, one box overhead, and a room
/// that is a little brighter at the horizon.
[[nodiscard]] Vec3 studio_radiance(Vec3 d);

/// The function as a panorama, 4 samples a texel.
[[nodiscard]] Image make_studio_panorama(int width);

}  // namespace dermis::inline scene
