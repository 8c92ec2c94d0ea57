#pragma once
// The tests' own integrator, as simple as possible: adaptive Simpson over the definition, without the
// library's closed forms, series or expansions.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace dermis::test {

using Integrand = std::function<double(double)>;

inline double simpson_step(const Integrand& f, double a, double fa, double b, double fb, double m, double fm,
                           double whole, double tolerance, int depth) {
    const double lm = 0.5 * (a + m), rm = 0.5 * (m + b), flm = f(lm), frm = f(rm);
    const double left = (m - a) / 6 * (fa + 4 * flm + fm), right = (b - m) / 6 * (fm + 4 * frm + fb);
    const double difference = left + right - whole;
    if (depth <= 0 || std::abs(difference) < 15 * tolerance) return left + right + difference / 15;
    return simpson_step(f, a, fa, m, fm, lm, flm, left, tolerance / 2, depth - 1) +
           simpson_step(f, m, fm, b, fb, rm, frm, right, tolerance / 2, depth - 1);
}

inline double integrate(const Integrand& f, double a, double b, double tolerance) {
    if (!(b > a)) return 0;
    const double m = 0.5 * (a + b), fa = f(a), fb = f(b), fm = f(m);
    return simpson_step(f, a, fa, b, fb, m, fm, (b - a) / 6 * (fa + 4 * fm + fb), tolerance, 40);
}

/// Edges from 0 to `end` that double in width from `finest`, and close in on a kink from both sides.
inline std::vector<double> graded_edges(double end, double finest, double kink) {
    std::vector<double> edges = {0, end};
    for (double edge = finest; edge < end; edge *= 2) edges.push_back(edge);
    for (double step = finest / 8; step < end; step *= 4)
        for (double edge : {kink - step, kink, kink + step})
            if (edge > 0 && edge < end) edges.push_back(edge);
    std::ranges::sort(edges);
    return edges;
}

inline double integrate_over(const Integrand& f, const std::vector<double>& edges, double tolerance) {
    double sum = 0;
    for (size_t i = 1; i < edges.size(); ++i) sum += integrate(f, edges[i - 1], edges[i], tolerance);
    return sum;
}

/// int weight(x) light(x) dx / int weight(x) dx to about 1e-9, for light in 0..1.
inline double weighted_mean(const Integrand& weight, const Integrand& light,
                            const std::vector<double>& edges) {
    double rough = 0;
    for (size_t i = 1; i < edges.size(); ++i) rough += integrate(weight, edges[i - 1], edges[i], 1e300);
    const double tolerance = 1e-11 * rough;
    const auto product = [&](double x) { return weight(x) * light(x); };
    return integrate_over(product, edges, tolerance) / integrate_over(weight, edges, tolerance);
}

/// Mean of max(0, n.l) over the ring of the unit sphere at the angle x from a point of elevation b, by
/// quadrature in azimuth.
inline double ring_mean(double b, double x) {
    const double p = std::sin(b) * std::cos(x), q = std::cos(b) * std::sin(x);
    const double lit_to = p >= q ? std::numbers::pi : p <= -q ? 0.0 : std::acos(-p / q);
    const auto light = [&](double azimuth) { return std::max(0.0, p + q * std::cos(azimuth)); };
    return integrate(light, 0, lit_to, 1e-12) / std::numbers::pi;
}

using Channel = std::function<double(double distance_mm)>;

/// The sphere's D as it is defined: the profile at the chord, over the area of the sphere.
inline double sphere_integral(const Channel& profile, double finest_mm, double t, double radius_mm) {
    const double b = std::asin(t);
    const auto weight = [&](double x) { return profile(2 * radius_mm * std::sin(x / 2)) * std::sin(x); };
    const auto light = [&](double x) { return ring_mean(b, x); };
    return weighted_mean(weight, light, graded_edges(std::numbers::pi, finest_mm / radius_mm, std::abs(b)));
}

/// The ring's D, from -span to span.
inline double ring_integral(const Channel& profile, double finest_mm, double t, double radius_mm,
                            double span) {
    const double theta = std::acos(t);
    const auto weight = [&](double x) { return profile(2 * radius_mm * std::sin(x / 2)); };
    const auto light = [&](double x) {
        return 0.5 * (std::max(0.0, std::cos(theta + x)) + std::max(0.0, std::cos(theta - x)));
    };
    return weighted_mean(weight, light, graded_edges(span, finest_mm / radius_mm, std::abs(std::asin(t))));
}

}  // namespace dermis::test
