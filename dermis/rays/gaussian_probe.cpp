#include "dermis/rays/gaussian_probe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dermis::inline rays {
namespace {

float mean(const Rgb& v) {
    return float((v[0] + v[1] + v[2]) / 3);
}

}  // namespace

ProbeAt probe_at(const GaussianSum& profile, double r_mm) {
    double rgb[3] = {}, density = 0, total = 0;
    for (const GaussianTerm& term : profile.terms) {
        const double g =
            std::exp(-r_mm * r_mm / (2 * term.variance_mm2)) / (2 * std::numbers::pi * term.variance_mm2);
        for (size_t c = 0; c < 3; ++c) rgb[c] += term.weight[c] * g;
        density += double(mean(term.weight)) * g;
        total += double(mean(term.weight));
    }
    return {float(density / total), {float(rgb[0]), float(rgb[1]), float(rgb[2])}};
}

float sample_probe_radius_mm(const GaussianSum& profile, Pcg32& random) {
    float total = 0;
    for (const GaussianTerm& term : profile.terms) total += mean(term.weight);
    float u = random.next_1d() * total;
    double variance = profile.terms.back().variance_mm2;
    for (const GaussianTerm& term : profile.terms) {
        if (u < mean(term.weight)) {
            variance = term.variance_mm2;
            break;
        }
        u -= mean(term.weight);
    }
    return float(std::sqrt(-2 * variance * std::log(double(std::max(1 - random.next_1d(), 1e-7f)))));
}

}  // namespace dermis::inline rays
