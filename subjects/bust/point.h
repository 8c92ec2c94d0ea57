#pragma once
// Double-precision points for the bust's distance field: second derivatives by differences need the digits.

#include <algorithm>
#include <cmath>

namespace dermis::bust {

struct Point {
    double x = 0, y = 0, z = 0;
};

constexpr Point operator+(Point a, Point b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Point operator-(Point a, Point b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Point operator*(Point a, double s) {
    return {a.x * s, a.y * s, a.z * s};
}
constexpr double dot(Point a, Point b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Point cross(Point a, Point b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Point a) {
    return std::sqrt(dot(a, a));
}
inline Point unit(Point a) {
    const double l = length(a);
    return l > 1e-300 ? a * (1.0 / l) : Point{};
}
constexpr Point mirrored(Point a) {
    return {-a.x, a.y, a.z};
}
constexpr float mixf(float a, float b, float t) {
    return a + (b - a) * t;
}
constexpr double mix(double a, double b, double t) {
    return a + (b - a) * t;
}
constexpr Point mix(Point a, Point b, double t) {
    return a + (b - a) * t;
}

/// 1 at 0, falling smoothly to 0 at -1 and 1.
constexpr double bump(double t) {
    const double rest = std::max(0.0, 1 - t * t);
    return rest * rest * rest;
}
/// 0 below `low`, 1 above `high`, with continuous first and second derivatives (Perlin 2002, quintic fade).
constexpr double smooth_step(double low, double high, double v) {
    const double t = std::clamp((v - low) / (high - low), 0.0, 1.0);
    return t * t * t * (t * (6 * t - 15) + 10);
}

/// Union whose seam is rounded over |a - b| < k; equal to the smaller one outside it, so a part further away
/// than k may be left out altogether. Continuous second derivatives (Quilez 2013, cubic smooth minimum).
inline double smooth_min(double a, double b, double k) {
    const double h = std::max(k - std::abs(a - b), 0.0) / k;
    return std::min(a, b) - h * h * h * k * (1.0 / 6.0);
}
inline double smooth_max(double a, double b, double k) {
    return -smooth_min(-a, -b, k);
}

}  // namespace dermis::bust
