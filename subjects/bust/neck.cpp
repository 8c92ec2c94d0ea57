// Neck and shoulders: an elliptic column that leans forward, sternomastoids, larynx, trapezius and collar
// bones, cut below by an ellipsoid.

#include <span>

#include "subjects/bust/parts.h"

namespace dermis::bust {
namespace {

struct Ring {
    double y, center_z, half_width, half_depth;
};
// Column of the neck, from inside the skull to inside the chest.
constexpr Ring kNeck[] = {{30, -20, 40, 42},   {-20, -14, 46, 47},  {-60, -10, 50, 50},
                          {-90, -9, 51, 53},   {-115, -11, 53, 55}, {-140, -18, 55, 55},
                          {-165, -25, 60, 54}, {-200, -28, 72, 58}, {-250, -28, 80, 64}};
// Trapezius: from the nape out to the shoulders.
constexpr Ring kTrapezius[] = {{-20, -34, 20, 16},   {-70, -36, 42, 23},   {-105, -38, 60, 27},
                               {-130, -40, 84, 31},  {-150, -40, 108, 35}, {-168, -38, 136, 40},
                               {-185, -36, 168, 46}, {-215, -33, 186, 56}, {-260, -33, 190, 60}};

double column(std::span<const Ring> rings, Point p) {
    size_t i = 0;
    while (i + 2 < rings.size() && p.y < rings[i + 1].y) ++i;
    const double span = rings[i].y - rings[i + 1].y;
    const double t = std::clamp((rings[i].y - p.y) / span, 0.0, 1.0);
    double slope = 0;
    const auto at = [&](auto member) {
        const auto tangent = [&](size_t k) {
            if (k == 0 || k + 1 == rings.size()) return 0.0;
            return (rings[k + 1].*member - rings[k - 1].*member) / (rings[k - 1].y - rings[k + 1].y);
        };
        const double a = rings[i].*member, b = rings[i + 1].*member, t2 = t * t, t3 = t2 * t;
        slope = mix(tangent(i), tangent(i + 1), t);
        return a * (2 * t3 - 3 * t2 + 1) + b * (3 * t2 - 2 * t3) +
               span * (tangent(i) * (t3 - 2 * t2 + t) + tangent(i + 1) * (t3 - t2));
    };
    const double z = p.z - at(&Ring::center_z), b = at(&Ring::half_depth), a = at(&Ring::half_width);
    const double k = std::hypot(p.x / a, z / b), steep = std::hypot(p.x / (a * a), z / (b * b));
    if (steep < 1e-9) return -std::min(a, b);
    // Where the column widens downwards, the horizontal distance is longer than the distance to the surface.
    const double widening = slope * std::abs(p.x) / a;
    const double side = k * (k - 1) / steep / std::sqrt(1 + widening * widening);
    return std::max(side, p.y - rings[0].y);
}

}  // namespace

double add_neck(double d, Point p) {
    if (p.y > 30) return d;
    d = smooth_min(d, column(kNeck, p), 16);
    d = smooth_min(d, column(kTrapezius, p), 34);
    const Point q = {std::abs(p.x), p.y, p.z};
    // Sternomastoid: mastoid process behind the ear to the sternum, and a flatter head to the collar bone.
    const double sternal = smooth_min(swept_ball(q, {54, -22, -12}, 9, {46, -84, 0}, 12),
                                      swept_ball(q, {46, -84, 0}, 12, {12, -166, 27}, 5.5), 8);
    d = smooth_min(d, sternal, 24);
    d = smooth_min(d, swept_ball(q, {47, -96, -6}, 10, {40, -168, 12}, 5), 30);
    // Splenius behind it; scalenes fill the triangle between it and the trapezius.
    d = smooth_min(d, swept_ball(q, {38, -84, -24}, 14, {54, -158, -14}, 12), 24);
    d = smooth_min(d, swept_ball(q, {40, -10, -36}, 16, {34, -90, -34}, 18), 26);
    // Chest and collar bones.
    const Ellipsoid chest = {{0, -252, -20}, {195, 98, 80}};
    d = smooth_min(d, chest.distance_mm(p), 26);
    const double bone = smooth_min(swept_ball(q, {14, -173, 23}, 6, {62, -171, 19}, 5),
                                   swept_ball(q, {62, -171, 19}, 5, {150, -172, -26}, 7), 20);
    d = smooth_min(d, bone, 26);
    // Thyroid cartilage and windpipe.
    d = smooth_min(d, swept_ball(p, {0, -112, 34}, 7, {0, -124, 33}, 7.5), 22);
    d = smooth_min(d, swept_ball(p, {0, -128, 29}, 10, {0, -172, 14}, 10), 28);
    return d;
}

namespace {
// An oval column cut off level, its lower edge well rounded.
double cut_distance(Point p) {
    const double a = 128, b = 92, z = p.z + 22;
    const double k = std::hypot(p.x / a, z / b),
                 steep = std::max(std::hypot(p.x / (a * a), z / (b * b)), 1e-9);
    const double cut = smooth_max(k * (k - 1) / steep, -208 - p.y, 40);
    // The cut is lower below the chin, which is in front of it.
    return cut - 90 * smooth_step(-152, -112, p.y);
}
}  // namespace

double cut_bust(double d, Point p) {
    return p.y > -112 ? d : smooth_max(d, cut_distance(p), 7);
}

bool on_cut(Point p) {
    return p.y < -192 && cut_distance(p) > -2.0;
}

}  // namespace dermis::bust
