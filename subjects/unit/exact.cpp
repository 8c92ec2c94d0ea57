#include "subjects/unit/exact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "dermis/optics/preintegration.h"
#include "dermis/optics/shadow_edge.h"

namespace dermis::unit {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

Vec3 rgb(const Rgb& value) {
    return {float(value[0]), float(value[1]), float(value[2])};
}

// sum_i w_i above_i / sum_i w_i below_i, for each channel; `of` gives {above, below} of a Gaussian.
template <class Of>
Rgb weighted_quotient(const GaussianSum& profile, Of of) {
    Rgb above = {}, below = {};
    for (const GaussianTerm& term : profile.terms) {
        const auto [a, b] = of(std::sqrt(term.variance_mm2));
        for (size_t c = 0; c < 3; ++c) {
            above[c] += term.weight[c] * a;
            below[c] += term.weight[c] * b;
        }
    }
    for (size_t c = 0; c < 3; ++c) above[c] /= below[c];
    return above;
}

// disk_share() as a sum of sharp edges at `s` with weights that sum to 1: the integral over its slope, (2 /
// pi) sqrt(1 - s^2), by the Gauss-Chebyshev rule of the second kind.
struct SharpEdge {
    double s, weight;
};
std::vector<SharpEdge> sharp_edges() {
    constexpr int kCount = 64;
    std::vector<SharpEdge> edges;
    for (int k = 1; k <= kCount; ++k) {
        const double angle = k * std::numbers::pi / (kCount + 1);
        edges.push_back({std::cos(angle), 2 * std::sin(angle) * std::sin(angle) / (kCount + 1)});
    }
    return edges;
}

}  // namespace

ExactExitance exact_sphere(Vec3 center_mm, float radius_mm, Vec3 to_light) {
    return [=](const GaussianSum& profile, float, Vec3 p_mm) -> ExactPoint {
        const double t = dot(normalize(p_mm - center_mm), to_light);
        return {.irradiance = float(std::max(t, 0.0)),
                .exitance = rgb(preintegrated_diffuse(profile, t, radius_mm))};
    };
}

ExactExitance exact_cylinder(float radius_mm, Vec3 to_light) {
    return [=](const GaussianSum& profile, float, Vec3 p_mm) -> ExactPoint {
        const double t = dot(normalize(Vec3{p_mm.x, 0, p_mm.z}), to_light);
        const Preintegration ring{.construction = Construction::full_ring, .ring_weights = RingWeights::line};
        return {.irradiance = float(std::max(t, 0.0)),
                .exitance = rgb(preintegrated_diffuse(profile, t, radius_mm, ring))};
    };
}

ExactExitance exact_shadow_edge(float half_width_mm, Vec3 to_light) {
    return [=, edges = sharp_edges()](const GaussianSum& profile, float penumbra_mm,
                                      Vec3 p_mm) -> ExactPoint {
        const double cosine = to_light.z, half_edge_mm = 0.5 * penumbra_mm / cosine, b = half_width_mm;
        const Rgb part = weighted_quotient(profile, [&](double sigma) {
            // The light between an edge and the strip's border, and the light of the whole strip.
            const double border = normal_cdf((b - p_mm.x) / sigma);
            double lit = 0;
            for (const SharpEdge& edge : edges) {
                const double from_mm = std::clamp(edge.s * half_edge_mm, -b, b);
                lit += edge.weight * (border - normal_cdf((from_mm - p_mm.x) / sigma));
            }
            return std::pair(lit, border - normal_cdf((-b - p_mm.x) / sigma));
        });
        const double sharp = p_mm.x > 0 ? 1 : 0;
        return {.irradiance = float(cosine * (half_edge_mm > 0 ? disk_share(p_mm.x / half_edge_mm) : sharp)),
                .exitance = rgb(part) * float(cosine)};
    };
}

ExactExitance exact_slab(float thickness_mm, Vec3 to_light) {
    return [=](const GaussianSum& profile, float, Vec3) -> ExactPoint {
        // The far face is at the distance sqrt(d^2 + h^2): its Gaussian is the near one times exp(-h^2 / 2v).
        const Rgb part = weighted_quotient(profile, [&](double sigma) {
            const double through = std::exp(-thickness_mm * thickness_mm / (2 * sigma * sigma));
            return std::pair(through, 1 + through);
        });
        return {.irradiance = 0, .exitance = rgb(part) * -to_light.z};
    };
}

ExactExitance exact_relief(float wavelength_mm, float slope, Vec3 to_light) {
    constexpr int kSamples = 64, kHarmonics = 4;
    const auto irradiance = [=](double phase) {
        const double rise = slope * std::cos(phase);
        return std::max(0.0, (to_light.z - to_light.x * rise) / std::sqrt(1 + rise * rise));
    };
    // Even in the phase: a sum of cosines.
    std::array<double, kHarmonics> amplitude = {};
    for (int k = 0; k < kHarmonics; ++k)
        for (int i = 0; i < kSamples; ++i) {
            const double phase = kTurn * i / kSamples;
            amplitude[size_t(k)] += irradiance(phase) * std::cos(k * phase) * (k > 0 ? 2 : 1) / kSamples;
        }
    return [=](const GaussianSum& profile, float, Vec3 p_mm) -> ExactPoint {
        const double phase = kTurn * p_mm.x / wavelength_mm;
        const Rgb blurred = weighted_quotient(profile, [&](double sigma) {
            double sum = 0;
            for (int k = 0; k < kHarmonics; ++k) {
                const double turns = kTurn * k * sigma / wavelength_mm;
                sum += amplitude[size_t(k)] * std::exp(-0.5 * turns * turns) * std::cos(k * phase);
            }
            return std::pair(sum, 1.0);
        });
        return {.irradiance = float(irradiance(phase)), .exitance = rgb(blurred)};
    };
}

}  // namespace dermis::unit
