#pragma once
// View and projection matrices of cameras and lights, for Vulkan's depth: 0 at the near plane, 1 at the far
// one. Column vectors and a right-handed view space: +x right, +y up, the view along -z.

#include "dermis/base/vec.h"

namespace dermis::inline scene {

[[nodiscard]] Mat4 operator*(const Mat4& a, const Mat4& b);

/// From world to view space. `forward` has length 1 and is not along `up`.
[[nodiscard]] Mat4 look_along(Vec3 eye_mm, Vec3 forward, Vec3 up);

/// The frustum of a pinhole camera, +y up.
[[nodiscard]] Mat4 perspective(float vertical_fov_rad, float aspect, float near_mm, float far_mm);

/// A box from -half_side_mm to +half_side_mm across.
[[nodiscard]] Mat4 orthographic(float half_side_mm, float near_mm, float far_mm);

/// Inverse of a matrix of look_along(): a rotation and a shift.
[[nodiscard]] Mat4 inverse_view(const Mat4& view);
/// Inverse of a matrix of perspective(), also with y turned down.
[[nodiscard]] Mat4 inverse_perspective(const Mat4& projection);

}  // namespace dermis::inline scene
