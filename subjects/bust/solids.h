#pragma once
// Solids that the head's parts are blended from. Distances are first-order near the surface, not exact.

#include <span>
#include <vector>

#include "subjects/bust/point.h"

namespace dermis::bust {

/// Distance to a ball swept from a to b while its radius goes from radius_a to radius_b.
inline double swept_ball(Point p, Point a, double radius_a, Point b, double radius_b) {
    const Point ab = b - a;
    const double t = std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0);
    return length(p - mix(a, b, t)) - mix(radius_a, radius_b, t);
}

/// Ellipsoid with axes of its own.
struct Ellipsoid {
    Point center, radii;
    Point axis_x = {1, 0, 0}, axis_y = {0, 1, 0}, axis_z = {0, 0, 1};

    /// Turned about the y axis, then about its own x axis (both by the right hand).
    [[nodiscard]] Ellipsoid turned(double yaw_rad, double pitch_rad) const {
        Ellipsoid e = *this;
        const double cy = std::cos(yaw_rad), sy = std::sin(yaw_rad);
        const double cp = std::cos(pitch_rad), sp = std::sin(pitch_rad);
        e.axis_x = {cy, 0, -sy};
        e.axis_y = {sy * sp, cp, cy * sp};
        e.axis_z = {sy * cp, -sp, cy * cp};
        return e;
    }
    [[nodiscard]] double distance_mm(Point p) const {
        const Point q = p - center;
        const Point u = {dot(q, axis_x) / radii.x, dot(q, axis_y) / radii.y, dot(q, axis_z) / radii.z};
        const Point v = {u.x / radii.x, u.y / radii.y, u.z / radii.z};
        const double k = length(u), slope = length(v);
        if (slope < 1e-9) return -std::min({radii.x, radii.y, radii.z});
        return k * (k - 1) / slope;
    }
};

/// A knot of a tube: where, and how thick.
struct Knot {
    Point at;
    double radius = 1;
};

/// A curved tube of varying radius through its knots (Catmull-Rom, resampled), with a ball of culling around
/// it.
class Tube {
  public:
    Tube() = default;
    Tube(std::span<const Knot> knots, int steps_per_span);
    [[nodiscard]] double distance_mm(Point p) const;

  private:
    std::vector<Knot> path_;
};

}  // namespace dermis::bust
