// Any radial profile on the sphere. The measure R(2r sin(x/2)) sin x dx is R(d) d dd in the chord d (over
// r^2), and the mean of max(0, n.l) over the ring of the sphere at the angle x from the shaded point is known
// in closed form, so one integral over d remains. Its integrand has a 3/2-power kink where that ring begins
// to touch the terminator (d = chord of the elevation b) and where it has passed it (the chord of pi - b):
// panels start at both, with d = start +- s^2, and double in width away from them.

#include <algorithm>
#include <cmath>

#include "dermis/optics/preintegration.h"
#include "dermis/optics/preintegration/quadrature.h"

namespace dermis::inline optics {
namespace {

using std::numbers::pi;

// Calls visit(d, weight) for the nodes of the panels from `start` towards `end` (either direction); the first
// is `first_mm` wide. visit returns how much of the profile the node held; panels end once they hold nothing.
template <class Visit>
void integrate_panels(double start, double end, double first_mm, const Visit& visit) {
    static const preintegration::GaussLegendre<16> rule;
    constexpr double kNothing = 1e-14;
    const double sign = end > start ? 1 : -1, length = std::abs(end - start);
    double from = 0, width = std::min(first_mm, length);
    for (int panel = 0; from < length; ++panel) {
        double held = 0;
        for (size_t i = 0; i < rule.size(); ++i) {
            const double u = rule.node(i);
            const double d = panel == 0 ? start + sign * width * u * u : start + sign * (from + width * u);
            held += visit(d, rule.weight(i) * width * (panel == 0 ? 2 * u : 1.0));
        }
        if (panel > 6 && held < kNothing) return;
        from += width;
        width = std::min(2 * width, length - from);
    }
}

// The mean of the clamped cosine over the ring at distance d of a point in the shadow, b below the
// terminator.
double lit_mean(double sine_b, double cosine_b, double chord_fraction_squared) {
    const double x_squared = chord_fraction_squared;  // (d / 2r)^2 = sin^2(x/2)
    const double p = -sine_b * (1 - 2 * x_squared);
    const double q = 2 * cosine_b * std::sqrt(std::max(0.0, x_squared * (1 - x_squared)));
    if (p <= -q) return 0;
    if (p >= q) return p;
    return (p * std::acos(-p / q) + std::sqrt((q - p) * (q + p))) / pi;
}

struct Moments {
    Rgb mass = {}, cosine = {}, second = {};  // of 1, cos x, P_2(cos x)
};

Moments moments_of(const RadialProfile& profile, double radius_mm) {
    Moments sum;
    integrate_panels(0, 2 * radius_mm, profile.finest_mm, [&](double d, double weight) {
        const Rgb value = profile.reflectance(d);
        const double cosine = 1 - d * d / (2 * radius_mm * radius_mm);
        double held = 0;
        for (size_t c = 0; c < 3; ++c) {
            const double mass = weight * d * value[c];
            sum.mass[c] += mass;
            sum.cosine[c] += mass * cosine;
            sum.second[c] += mass * (1.5 * cosine * cosine - 0.5);
            held = std::max(held, mass / sum.mass[c]);
        }
        return held;
    });
    for (size_t c = 0; c < 3; ++c) {
        sum.cosine[c] /= sum.mass[c];
        sum.second[c] /= sum.mass[c];
    }
    return sum;
}

Rgb tail_of(const RadialProfile& profile, double sine_b, double radius_mm, const Rgb& mass) {
    const double cosine_b = std::sqrt(std::max(0.0, 1 - sine_b * sine_b));
    const double diameter = 2 * radius_mm;
    // Chords of b and pi - b: 2r sin(b/2), 2r cos(b/2).
    const double far = diameter * std::sqrt(0.5 * (1 + cosine_b));
    const double near = radius_mm * sine_b * diameter / far;
    Rgb sum = {};
    const auto visit = [&](double d, double weight) {
        const double lit = lit_mean(sine_b, cosine_b, std::min(1.0, d / diameter * d / diameter));
        const Rgb value = profile.reflectance(d);
        double held = 0;
        for (size_t c = 0; c < 3; ++c) {
            const double share = weight * d * value[c] / mass[c];
            sum[c] += share * lit;
            held = std::max(held, share);
        }
        return held;
    };
    const double middle = 0.5 * (near + far);
    integrate_panels(near, middle, profile.finest_mm, visit);
    integrate_panels(far, middle, profile.finest_mm, visit);
    integrate_panels(far, diameter, profile.finest_mm, visit);
    return sum;
}

}  // namespace

std::vector<Rgb> preintegrated_diffuse(const RadialProfile& profile, std::span<const double> n_dot_l,
                                       double radius_mm) {
    std::vector<Rgb> values;
    const bool flat = std::isinf(radius_mm);
    const Moments moments = flat ? Moments{.cosine = {1, 1, 1}} : moments_of(profile, radius_mm);
    for (double t : n_dot_l) {
        Rgb value = flat ? Rgb{} : tail_of(profile, std::abs(t), radius_mm, moments.mass);
        for (size_t c = 0; c < 3; ++c) value[c] += moments.cosine[c] * std::max(0.0, t);
        values.push_back(value);
    }
    return values;
}

std::array<Rgb, 3> preintegrated_zonal_harmonics(const RadialProfile& profile, double radius_mm) {
    const Moments moments = std::isinf(radius_mm) ? Moments{.cosine = {1, 1, 1}, .second = {1, 1, 1}}
                                                  : moments_of(profile, radius_mm);
    std::array<Rgb, 3> zonal;
    for (size_t c = 0; c < 3; ++c) {
        zonal[0][c] = std::sqrt(pi) / 2;
        zonal[1][c] = std::sqrt(pi / 3) * moments.cosine[c];
        zonal[2][c] = std::sqrt(5 * pi) / 8 * moments.second[c];
    }
    return zonal;
}

}  // namespace dermis::inline optics
