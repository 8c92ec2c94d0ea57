// Eyelids and nose as blended solids. Positions after the average head in docs' table of measurements: pupils
// 62 mm apart, nose 50 mm long and 35 mm wide.

#include "dermis/bust/parts.h"

namespace dermis::bust {

double add_eyes(double d, Point p) {
    const Point q = {std::abs(p.x), p.y, p.z};
    const Point center = {31, 25, 80.5};
    const double ball = length(q - center);
    if (ball > 40) return d;
    // The lids over the ball, and the bulge of the cornea under the upper lid.
    double lid = ball - 13.8;
    lid = smooth_min(lid, length(q - Point{31, 22.5, 84}) - 10.6, 5);
    return smooth_min(d, lid, 9);
}

double lid_slit_y(double x) {
    // A downward arc, lowest outside the middle, the outer corner a little higher than the inner one.
    const double t = (x - 31.5) / 16.5;
    return 16.7 + 3.9 * t * t + 0.35 * t;
}

double add_nose(double d, Point p) {
    if (length(p - Point{0, 5, 108}) > 60) return d;
    const Point q = {std::abs(p.x), p.y, p.z};
    // Pyramid of the bone, then the ridge, then the tip.
    const double pyramid = smooth_min(swept_ball(p, {0, 34, 91}, 9.5, {0, 12, 97}, 13),
                                      swept_ball(p, {0, 12, 97}, 13, {0, -6, 102}, 15), 6);
    const double ridge = smooth_min(swept_ball(p, {0, 33, 98.3}, 6.4, {0, 16, 109.3}, 5.9),
                                    swept_ball(p, {0, 16, 109.3}, 5.9, {0, -3, 119.8}, 7.0), 6);
    double nose = smooth_min(pyramid, ridge, 13);
    const double tip =
        smooth_min(length(p - Point{3.5, -7.2, 121.4}) - 7.2, length(p - Point{-3.5, -7.2, 121.4}) - 7.2, 6);
    nose = smooth_min(nose, tip, 9);
    // Columella and the base between the wings.
    nose = smooth_min(nose, swept_ball(p, {0, -12.5, 121.5}, 3.8, {0, -19.5, 112}, 4.6), 5);
    const double body = smooth_min(d, nose, 10);
    // Wings.
    const Ellipsoid wing = Ellipsoid{{11.2, -11.6, 111.4}, {5.8, 7.4, 10.4}}.turned(-0.36, 0.28);
    double all = smooth_min(body, wing.distance_mm(q), 8.5);
    // Nostrils open down and a little outward, and run up and back.
    const Ellipsoid nostril = Ellipsoid{{6.5, -19.9, 113.6}, {2.2, 4.0, 4.8}}.turned(-0.42, 0.15);
    return smooth_max(all, -nostril.distance_mm(q), 2.4);
}

}  // namespace dermis::bust
