#pragma once
// A ball or a ball-shaped cavity as the boundary of a random walk.

#include <algorithm>
#include <cmath>
#include <optional>

#include "dermis/rays/random_walk.h"

namespace dermis::inline rays {

/// A sphere that touches the origin from below (ball, curvature above 0) or from above (cavity), where the
/// outward normal is +z.
struct SphereBoundary {
    float radius_mm, side;  // side: 1 ball, -1 cavity

    explicit SphereBoundary(double curvature_per_mm)
        : radius_mm(float(1 / std::abs(curvature_per_mm))), side(curvature_per_mm > 0 ? 1.0f : -1.0f) {}

    std::optional<BoundaryHit> operator()(Vec3 p_mm, Vec3 direction, float max_mm) const {
        const Vec3 from_centre = p_mm + Vec3{0, 0, side * radius_mm};
        const float along = dot(from_centre, direction);
        // |from_centre|^2 - r^2 without cancellation at the start, where p is 0.
        const float outside = dot(p_mm, p_mm) + 2 * side * radius_mm * p_mm.z;
        const float root2 = along * along - outside;
        if (side < 0 && (along >= 0 || root2 <= 0)) return std::nullopt;
        const float root = std::sqrt(std::max(root2, 0.0f));
        const float distance_mm = std::max(-along + side * root, 0.0f);
        if (distance_mm > max_mm) return std::nullopt;
        return BoundaryHit{distance_mm, normalize(from_centre + direction * distance_mm) * side};
    }
};

}  // namespace dermis::inline rays
