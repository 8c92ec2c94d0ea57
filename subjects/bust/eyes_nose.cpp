// Eyelids and nose as blended solids. Positions as in the table of measurements in docs/bust.md: pupils 62 mm
// apart, nose 50 mm long and 35 mm wide.

#include "subjects/bust/parts.h"

namespace dermis::bust {
namespace {

// Height of the lids' margins over the ball: the upper lid ends in an edge that overhangs the lower one.
double lid_margins(Point q) {
    const double ends = smooth_step(15.5, 23, q.x) * (1 - smooth_step(41, 48.5, q.x));
    if (ends <= 0) return 0;
    const double above = q.y - lid_slit_y(q.x);
    const double upper = 1.15 * smooth_step(-0.5, 0.5, above) * (1 - smooth_step(1.0, 10, above));
    const double lower = 0.35 * bump((above + 3.0) / 2.6) - 0.5 * bump((above + 0.75) / 1.3);
    return ends * (upper + lower);
}

}  // namespace

double add_eyes(double d, Point p) {
    const Point q = {std::abs(p.x), p.y, p.z};
    const Point center = {31.5, 24, 80.5};
    const double ball = length(q - center);
    if (ball > 40) return d;
    // The lids over the ball, and the bulge of the cornea under the upper lid.
    double lid = ball - 13.0;
    lid = smooth_min(lid, length(q - Point{32.5, 20.5, 84}) - 10.0, 5);
    return smooth_min(d, lid, 12) - (q.z > 70 ? lid_margins(q) : 0);
}

double lid_slit_y(double x) {
    // A downward arc, lowest outside the middle.
    const double t = (x - 32.5) / 16.5;
    return 15.6 + 4.6 * t * t - 0.5 * t;
}

namespace {

// Bridge: side planes that widen downwards, and the ridge that ends above the tip.
double bridge(Point p) {
    const double planes = smooth_min(swept_ball(p, {0, 36, 92}, 9.0, {0, 12, 95.5}, 14),
                                     swept_ball(p, {0, 12, 95.5}, 14, {0, -8, 99}, 17), 6);
    const double ridge = smooth_min(swept_ball(p, {0, 36, 98.6}, 6.2, {0, 17, 109.2}, 6.2),
                                    swept_ball(p, {0, 17, 109.2}, 6.2, {0, -3, 119.0}, 7.8), 6);
    return smooth_min(planes, ridge, 12);
}

// Two domes a few millimetres apart, the lobule below them, the columella back to the lip.
double tip_of_nose(Point p) {
    double tip =
        smooth_min(length(p - Point{3.7, -6.2, 123.0}) - 5.0, length(p - Point{-3.7, -6.2, 123.0}) - 5.0, 9);
    tip = smooth_min(tip, swept_ball(p, {0, -11.0, 122.0}, 4.2, {0, -15.5, 118.4}, 3.6), 7);
    return smooth_min(tip, swept_ball(p, {0, -15, 118.4}, 3.4, {0, -20.5, 110}, 4.2), 5);
}

}  // namespace

double add_nose(double d, Point p) {
    if (length(p - Point{0, 5, 108}) > 60) return d;
    const Point q = {std::abs(p.x), p.y, p.z};
    double nose = smooth_min(bridge(p), tip_of_nose(p), 10);
    // Wings: the wall from the tip back to the cheek, highest near the tip and fullest where it turns in.
    double wing = swept_ball(q, {4.0, -7.5, 116.5}, 6.8, {10.6, -10.6, 111.0}, 6.6);
    wing = smooth_min(wing, swept_ball(q, {10.6, -10.4, 111.6}, 6.6, {13.2, -12.6, 104.5}, 5.2), 7);
    wing = smooth_min(wing, swept_ball(q, {9.2, -13.6, 113.4}, 4.6, {13.2, -15.6, 106.6}, 3.6), 6);
    nose = smooth_min(nose, wing, 10);
    const double body = smooth_min(d, nose, 8);
    return smooth_max(body, -nostril_distance_mm(q), 2.6);
}

double nostril_distance_mm(Point p) {
    // Opens down and a little outward; runs up and forward under the tip.
    const Point q = {std::abs(p.x), p.y, p.z};
    const double opening = swept_ball(q, {5.0, -19.7, 115.4}, 2.5, {8.7, -20.2, 108.8}, 3.3);
    const double depth = swept_ball(q, {5.9, -17.0, 113}, 1.7, {7.8, -12.5, 108}, 1.9);
    return smooth_min(opening, depth, 3);
}

}  // namespace dermis::bust
