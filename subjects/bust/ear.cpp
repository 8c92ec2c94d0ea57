// The ear: a thin curved plate with a rolled rim (helix), a Y-shaped ridge (antihelix), a bowl (concha)
// carved through to the side of the head, and the flaps before and below the ear canal (tragus, antitragus).

#include <array>
#include <numbers>

#include "subjects/bust/parts.h"

namespace dermis::bust {
namespace {

constexpr double kStandardLength = 63;

// The plate's edge, counter-clockwise from the root of the helix, in the ear frame (back, up).
constexpr std::array<double, 2> kOutline[] = {
    {-6, 12},     {-5.5, 20}, {-1, 27},   {7, 31},     {15, 30.5},  {22, 26.5},
    {26.3, 18.5}, {27, 9},    {25.8, 0},  {23, -8.5},  {19.4, -16}, {16.2, -22.5},
    {12, -28.5},  {6, -31.5}, {0, -29.8}, {-4, -23.5}, {-6, -14},   {-7, 0},
};

constexpr Ellipsoid kBowl = {{7.5, 0.5, -2.5}, {12.0, 15.5, 8.5}};  // the concha seen from behind

// The upper ear leans back towards the head, and so does the lobe.
double lean(double v) {
    return 0.0045 * (v - 2) * (v - 2) - 0.5;
}

Point catmull(Point a, Point b, Point c, Point d, double t) {
    return b + ((c - a) + (a * 2 - b * 5 + c * 4 - d) * t + ((b - c) * 3 + d - a) * (t * t)) * (0.5 * t);
}

}  // namespace

Ear::Ear(double length_mm, double protrusion_rad) : scale_(length_mm / kStandardLength) {
    const double tilt = 14 * std::numbers::pi / 180;
    const Point rear = {0, -std::sin(tilt), -std::cos(tilt)}, side = {1, 0, 0};
    origin_ = {75.0, 4, 10};
    up_ = {0, std::cos(tilt), -std::sin(tilt)};
    back_ = rear * std::cos(protrusion_rad) + side * std::sin(protrusion_rad);
    out_ = side * std::cos(protrusion_rad) - rear * std::sin(protrusion_rad);

    const size_t n = std::size(kOutline);
    const auto knot = [&](size_t k) { return Point{kOutline[k % n][0], kOutline[k % n][1], 0}; };
    for (size_t i = 0; i < n; ++i)
        for (int k = 0; k < 4; ++k)
            outline_.push_back(catmull(knot(i + n - 1), knot(i), knot(i + 1), knot(i + 2), k / 4.0));

    const auto flat = [](Point p) { return p; };
    const auto relief = [&](std::initializer_list<StrokePoint> curve) {
        relief_.add(std::span(curve.begin(), curve.size()), Mirror::no, flat);
    };
    relief(
        {{{18, 23}, 6, -0.7}, {{21.5, 12}, 6, -1.2}, {{20.5, 1}, 6, -1.2}, {{17, -9}, 5, -0.6}});  // scapha
    relief({{{4, 22}, 5, -0.6}, {{10, 20}, 6, -1.2}, {{13, 18}, 5, -0.6}});  // triangular fossa
    relief({{{3, -20}, 10, 0.8}, {{6, -26}, 8, 0.6}});                       // lobe
    relief_.build();

    const Knot rim[] = {{{-6.5, 8, -1.5}, 2.6},   {{-6.3, 16, 0.2}, 3.0},     {{-2.5, 24.5, 1.4}, 3.4},
                        {{5.5, 29.0, 2.0}, 3.3},  {{14, 28.8, 2.0}, 3.2},     {{21, 24.8, 1.6}, 3.0},
                        {{24.8, 17.8, 1.0}, 2.8}, {{25.4, 9, 0.6}, 2.6},      {{24.2, 0.5, 0.2}, 2.4},
                        {{21.6, -8, 0}, 2.4},     {{18.2, -15.5, -0.2}, 2.1}, {{15.2, -21.5, -0.4}, 1.6}};
    helix_ = Tube(rim, 3);
    const Knot ridge[] = {{{7.0, -12.0, 0.2}, 2.6}, {{12, -10.0, -0.2}, 3.0}, {{15.8, -4, -0.6}, 3.6},
                          {{16.8, 4, -0.4}, 4.0},   {{15.0, 12, -0.4}, 3.8},  {{12, 19, -1.0}, 3.0},
                          {{10, 24, -1.8}, 2.0}};
    antihelix_ = Tube(ridge, 3);
    const Knot lower[] = {
        {{16.4, 6, -0.6}, 3.6}, {{11.5, 12.4, -0.4}, 3.0}, {{5, 14.6, -0.8}, 2.6}, {{-2, 15.4, -1.6}, 2.0}};
    crus_ = Tube(lower, 3);
}

Point Ear::to_ear(Point p) const {
    const Point q = p - origin_;
    return Point{dot(q, back_), dot(q, up_), dot(q, out_)} * (1 / scale_);
}

double Ear::outline(double u, double v) const {
    double nearest2 = 1e18;
    bool inside = false;
    for (size_t i = 0, j = outline_.size() - 1; i < outline_.size(); j = i++) {
        const Point a = outline_[j], b = outline_[i];
        const double ex = b.x - a.x, ey = b.y - a.y, wx = u - a.x, wy = v - a.y;
        const double t = std::clamp((wx * ex + wy * ey) / (ex * ex + ey * ey), 0.0, 1.0);
        const double dx = wx - t * ex, dy = wy - t * ey;
        nearest2 = std::min(nearest2, dx * dx + dy * dy);
        if ((a.y > v) != (b.y > v) && u < a.x + ex * (v - a.y) / ey) inside = !inside;
    }
    const double distance = std::sqrt(nearest2);
    return inside ? -distance : distance;
}

double Ear::plate(Point q) const {
    const double height = relief_.at({q.x, q.y, 0}) - 0.6;
    // The lobe is thicker and soft; the plate thins towards the top.
    const double lobe = smooth_step(-8, -20, q.y);
    const double half = mix(1.5, 2.2, lobe);
    return smooth_max(std::abs(q.z - height) - half, outline(q.x, q.y), mix(1.6, 4.2, lobe));
}

double Ear::add(double d, Point p) const {
    Point q = to_ear({std::abs(p.x), p.y, p.z});
    if (length(q - Point{9, 0, 0}) > 46) return d;
    q.z += lean(q.y);
    double ear = plate(q);
    ear = smooth_min(ear, helix_.distance_mm(q), 2.2);
    ear = smooth_min(ear, antihelix_.distance_mm(q), 4.5);
    ear = smooth_min(ear, crus_.distance_mm(q), 3.5);
    ear = smooth_min(ear, smooth_max(kBowl.distance_mm(q), q.z + 0.5, 3), 3.5);
    double all = smooth_min(d, ear * scale_, 4.5);
    // The concha, with the root of the helix running out into it.
    const Ellipsoid cavum = {{5.2, -3.8, 1.6}, {9.6, 9.4, 9.4}}, cymba = {{7.4, 7.6, 1.2}, {8.2, 5.2, 7.4}};
    const double concha = smooth_min(cavum.distance_mm(q), cymba.distance_mm(q), 5.0);
    all = smooth_max(all, -concha * scale_, 2.4);
    const double root = smooth_min(swept_ball(q, {-6.8, 11, -0.6}, 2.8, {-1, 6.6, -3.6}, 1.9),
                                   swept_ball(q, {-1, 6.6, -3.6}, 1.9, {4.5, 4.6, -7.6}, 1.0), 2.5);
    all = smooth_min(all, root * scale_, 3.0);
    // Ear canal, then the flaps that half cover it.
    const double canal = swept_ball(q, {0.0, -3.6, -3.5}, 3.2, {-6, -2, -9}, 2.4);
    all = smooth_max(all, -canal * scale_, 2.0);
    const Ellipsoid tragus = Ellipsoid{{-3.6, -4.0, 0.9}, {3.8, 5.4, 2.0}}.turned(-0.25, 0);
    all = smooth_min(all, tragus.distance_mm(q) * scale_, 3.4);
    const double antitragus = swept_ball(q, {5.6, -12.8, 0.4}, 2.2, {9.5, -11.4, 0.6}, 2.4);
    return smooth_min(all, antitragus * scale_, 3.2);
}

Point Ear::to_head(Point q) const {
    return origin_ + (back_ * q.x + up_ * q.y + out_ * q.z) * scale_;
}

namespace {
// Where the ear ends in front, by the height in the ear frame: behind the tragus, in the crease before the
// helix's root and the lobe.
double front_edge(double v) {
    return mix(-5.6, 0.6, smooth_step(-11.5, -8.5, v) * (1 - smooth_step(4, 9, v)));
}
}  // namespace

bool Ear::on_ear(Point p, double head_distance) const {
    Point q = to_ear({std::abs(p.x), p.y, p.z});
    const double away = outline(q.x, q.y);
    if (length(q - Point{9, 0, 0}) > 46 || away > 4) return false;
    q.z += lean(q.y);
    // Half way through the plate, or through the wall of the bowl.
    double middle = relief_.at({q.x, q.y, 0}) - 0.6;
    const double u = (q.x - kBowl.center.x) / (kBowl.radii.x - 1),
                 v = (q.y - kBowl.center.y) / (kBowl.radii.y - 1);
    const double inside = 1 - u * u - v * v;
    if (inside > 0) middle = std::min(middle, kBowl.center.z - (kBowl.radii.z - 1.2) * std::sqrt(inside));
    if (q.z <= middle) return head_distance > 3.0;  // the back of the ear ends in the groove at the head
    if (q.x < front_edge(q.y) && q.z > -2.5) return false;
    return away < 1.0 || head_distance > 2.0;
}

}  // namespace dermis::bust
