// Composition of the parts: skull and neck, strokes of form, features, strokes of detail, ears, cut.

#include "subjects/bust/field.h"

#include <numbers>

namespace dermis {

using namespace bust;

namespace {
constexpr double kGradientStep = 0.02;

Point difference(const auto& f, Point p, double h) {
    return Point{f(p + Point{h, 0, 0}) - f(p - Point{h, 0, 0}), f(p + Point{0, h, 0}) - f(p - Point{0, h, 0}),
                 f(p + Point{0, 0, h}) - f(p - Point{0, 0, h})} *
           (0.5 / h);
}

// Forward differences: three more values per step are exact enough for the direction.
Point newton(const auto& f, Point p, int steps) {
    constexpr double h = kGradientStep;
    for (int i = 0; i < steps; ++i) {
        const double d = f(p);
        const Point g =
            Point{f(p + Point{h, 0, 0}) - d, f(p + Point{0, h, 0}) - d, f(p + Point{0, 0, h}) - d} * (1 / h);
        const double steepness = std::sqrt(std::max(dot(g, g), 1e-3));
        p = p - g * (std::clamp(d / steepness, -4.0, 4.0) / steepness);
    }
    return p;
}
}  // namespace

BustField::BustField(const BustParams& params)
    : params_(params), ear_(params.ear_length_mm, params.ear_protrusion_deg * std::numbers::pi / 180) {
    uint64_t state = uint64_t(params.seed) * 0x9e3779b97f4a7c15ull + 1;
    for (double& phase : phase_) {
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        phase = double(state >> 11) / double(1ull << 53) * 2 * std::numbers::pi;
    }
    add_form_strokes(form_strokes_, [&](Point p) {
        return newton([&](Point q) { return add_neck(skull_.distance_mm(q), q); }, p, 6);
    });
    form_strokes_.build();
    add_detail_strokes(detail_strokes_,
                       [&](Point p) { return newton([&](Point q) { return solids(q); }, p, 6); });
    detail_strokes_.build();
}

double BustField::forms(Point p) const {
    return add_neck(skull_.distance_mm(p), p) - form_strokes_.at(p);
}

double BustField::solids(Point p) const {
    return add_lips(add_nose(add_eyes(forms(p), p), p), p, params_.lip_fullness);
}

Point BustField::to_standard(Point p) const {
    const BustParams standard;
    Point q = p;
    // Proportions: the face grows downwards from the nasion with the nose; breadths fade towards the neck.
    const double below = 1 - smooth_step(-21, 39, p.y), front = smooth_step(-10, 70, p.z);
    q.y += (params_.nose_length_mm - standard.nose_length_mm) * below * front;
    const double head = smooth_step(-110, -10, q.y);
    const double jaw =
        smooth_step(-125, -60, q.y) * (1 - smooth_step(-50, 10, q.y)) * smooth_step(-50, 0, q.z);
    const double nose_box =
        smooth_step(92, 112, q.z) * smooth_step(-30, -16, q.y) * (1 - smooth_step(10, 30, q.y));
    q.x /= 1 + (params_.head_width_mm / standard.head_width_mm - 1) * head;
    q.x /= 1 + (params_.jaw_width_mm / standard.jaw_width_mm - 1) * jaw;
    q.x /= 1 + (params_.nose_width_mm / standard.nose_width_mm - 1) * nose_box;
    // Waves of low frequency that differ from left to right, about a millimetre high each.
    const double a = params_.asymmetry;
    q.x += a * (1.1 * std::sin(p.y / 40 + phase_[0]) * std::exp(-p.x * p.x / 3600) +
                0.3 * std::sin(p.z / 40 + phase_[1]));
    q.y += a * (1.0 * std::sin(p.x / 42 + phase_[2]) + 0.4 * std::sin(p.x / 17 + phase_[3]));
    q.z += a * (0.7 * std::sin(p.x / 45 + phase_[4]) + 0.3 * std::sin(p.x / 23 + p.y / 30 + phase_[5]));
    return q;
}

double BustField::distance_mm(Point p_world) const {
    const Point p = to_standard(p_world);
    double d = solids(p) - detail_strokes_.at(p);
    d = ear_.add(d, p);
    return cut_bust(d, p);
}

Point BustField::gradient(Point p) const {
    return difference([&](Point q) { return distance_mm(q); }, p, kGradientStep);
}

Point BustField::project(Point p, int steps) const {
    return newton([&](Point q) { return distance_mm(q); }, p, steps);
}

double BustField::mean_curvature_per_mm(Point p, double h) const {
    const auto n = [&](Point q) { return unit(difference([&](Point r) { return distance_mm(r); }, q, h)); };
    const Point x = {h, 0, 0}, y = {0, h, 0}, z = {0, 0, h};
    const double divergence =
        (n(p + x).x - n(p - x).x + n(p + y).y - n(p - y).y + n(p + z).z - n(p - z).z) / (2 * h);
    return 0.5 * divergence;
}

double BustField::thickness_mm(Point p, double most_mm) const {
    const Point inward = normal(p) * -1;
    double t = 0.05, last = distance_mm(p + inward * t);
    while (t < most_mm) {
        const double step = std::clamp(-last * 0.6, 0.05, 2.0);
        const double now = distance_mm(p + inward * (t + step));
        if (now >= 0) return t + step * last / (last - now);
        t += step;
        last = now;
    }
    return most_mm;
}

}  // namespace dermis
