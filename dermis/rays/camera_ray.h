#pragma once
// The ray that a point of the picture is seen by.

#include "dermis/rays/ray_scene.h"

namespace dermis::inline rays {

/// m * p, divided by w.
[[nodiscard]] inline Vec3 project(const Mat4& m, Vec3 p) {
    const auto row = [&](int r) { return m.m[r] * p.x + m.m[4 + r] * p.y + m.m[8 + r] * p.z + m.m[12 + r]; };
    return Vec3{row(0), row(1), row(2)} * (1 / row(3));
}

/// `x` and `y` in pixels from the upper left corner; ends at the far plane.
[[nodiscard]] inline Ray camera_ray(const Mat4& inverse_view_projection, float x, float y, int width,
                                    int height) {
    const float clip_x = 2 * x / float(width) - 1, clip_y = 2 * y / float(height) - 1;
    const Vec3 near_mm = project(inverse_view_projection, {clip_x, clip_y, 0});
    const Vec3 far_mm = project(inverse_view_projection, {clip_x, clip_y, 1});
    return {
        .origin_mm = near_mm, .direction = normalize(far_mm - near_mm), .max_mm = length(far_mm - near_mm)};
}

}  // namespace dermis::inline rays
