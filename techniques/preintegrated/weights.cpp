#include "techniques/preintegrated/weights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/bake/shadow_ramp.h"
#include "shaders/include/constants.h"
#include "techniques/preintegrated/constants.h"

namespace dermis::preintegrated {
namespace {

constexpr double kWidestShare = 0.5;

// Of two Gaussians along a line under a spectrum 1 / k^2, without the constant that all pairs share.
double inner_product(double variance_sum_mm2) {
    return -std::sqrt(variance_sum_mm2);
}

// Along one axis. The variance of a sum of Gaussians is the weighted mean of their variances.
double largest_variance_mm2(const GaussianSum& profile) {
    double largest = 0;
    for (size_t c = 0; c < 3; ++c) {
        double sum = 0, weight = 0;
        for (const GaussianTerm& term : profile.terms)
            sum += term.weight[c] * term.variance_mm2, weight += term.weight[c];
        if (weight > 0) largest = std::max(largest, sum / weight);
    }
    return largest;
}

double weight_of(const GaussianSum& profile, size_t channel, double s0, double s1) {
    double total = 0, kept = 0;  // kept: <T(s0), G(s0) - G(s1)>
    for (const GaussianTerm& term : profile.terms) {
        const double v = term.variance_mm2, w = term.weight[channel];
        kept += w * (inner_product(2 * s0 + v) - inner_product(s0 + s1 + v));
        total += w;
    }
    if (total <= 0) return 0;
    const double difference = inner_product(2 * s0) - inner_product(s0 + s1) - kept / total;
    const double norm = inner_product(2 * s0) - 2 * inner_product(s0 + s1) + inner_product(2 * s1);
    return std::clamp(difference / norm, 0.0, 1.0);
}

NormalBlend blend_of_levels(const GaussianSum& profile, double sharp_mm, double levels) {
    NormalBlend blend{.lod_bias = levels};
    const double smooth_mm = sharp_mm * std::exp2(levels);
    for (size_t c = 0; c < 3; ++c)
        blend.weight[c] = weight_of(profile, c, sharp_mm * sharp_mm / 12, smooth_mm * smooth_mm / 12);
    return blend;
}

}  // namespace

double widest_blend_mm(const GaussianSum& profile) {
    return kWidestShare * std::sqrt(12 * largest_variance_mm2(profile));
}

NormalBlend normal_blend(const GaussianSum& profile, double sharp_mm) {
    const double levels =
        std::clamp(std::log2(widest_blend_mm(profile) / sharp_mm), 0.0, double(kPublishedNormalLevels));
    return levels < 1e-3 ? NormalBlend{} : blend_of_levels(profile, sharp_mm, levels);
}

NormalBlend published_normal_blend(const GaussianSum& profile, double sharp_mm) {
    return blend_of_levels(profile, sharp_mm, double(kPublishedNormalLevels));
}

std::array<Rgb, 3> occlusion_blend(const GaussianSum& profile) {
    const std::array<double, 4> kVariances_mm2 = {0, kOcclusionVariance0Mm2, kOcclusionVariance1Mm2,
                                                  kOcclusionVariance2Mm2};
    std::array<Rgb, 4> shares = {};
    Rgb total = {};
    for (const GaussianTerm& term : profile.terms) {
        const double v = std::min(term.variance_mm2, kVariances_mm2.back());
        size_t i = 0;
        while (v > kVariances_mm2[i + 1]) ++i;
        const double upper = (v - kVariances_mm2[i]) / (kVariances_mm2[i + 1] - kVariances_mm2[i]);
        for (size_t c = 0; c < 3; ++c) {
            shares[i][c] += term.weight[c] * (1 - upper);
            shares[i + 1][c] += term.weight[c] * upper;
            total[c] += term.weight[c];
        }
    }
    std::array<Rgb, 3> weights = {};
    for (size_t i = 0; i < 3; ++i)
        for (size_t c = 0; c < 3; ++c) weights[i][c] = total[c] > 0 ? shares[i + 1][c] / total[c] : 0;
    return weights;
}

namespace {

// Taps do not resolve a sharper edge.
constexpr double kNarrowestVariance_mm2 = 0.03;
constexpr int kRadialSteps = 512, kDiskSteps = 96;
constexpr double kReachInDeviations = 4;

// exp(-x) I0(x); the library's I0 overflows from x = 700.
double scaled_bessel_0(double x) {
    if (x < 50) return std::exp(-x) * std::cyl_bessel_i(0.0, x);
    return (1 + 1 / (8 * x) + 9 / (128 * x * x)) / std::sqrt(2 * std::numbers::pi * x);
}

struct Around {
    double radius_mm = 0;
    Rgb light = {};       // per channel; the integral over the plane is 1
    double penumbra = 0;  // the disk alone
};

std::vector<Around> light_around(const GaussianSum& profile) {
    const double disk_mm = 0.5 * kLightEdgeMm;
    double widest_mm2 = kNarrowestVariance_mm2;
    Rgb total = {};
    for (const GaussianTerm& term : profile.terms) {
        widest_mm2 = std::max(widest_mm2, term.variance_mm2);
        for (size_t c = 0; c < 3; ++c) total[c] += term.weight[c];
    }
    const double reach_mm = disk_mm + kReachInDeviations * std::sqrt(widest_mm2);
    std::vector<Around> around;
    for (int i = 0; i < kRadialSteps; ++i) {
        Around here = {.radius_mm = reach_mm * (i + 0.5) / kRadialSteps};
        here.penumbra = gaussian_over_disk(kNarrowestVariance_mm2, disk_mm, here.radius_mm);
        for (const GaussianTerm& term : profile.terms) {
            const double variance_mm2 = std::max(double(term.variance_mm2), kNarrowestVariance_mm2);
            const double part = gaussian_over_disk(variance_mm2, disk_mm, here.radius_mm);
            for (size_t c = 0; c < 3; ++c)
                if (total[c] > 0) here.light[c] += term.weight[c] / total[c] * part;
        }
        for (size_t c = 0; c < 3; ++c)
            if (total[c] <= 0) here.light[c] = here.penumbra;
        around.push_back(here);
    }
    return around;
}

// The channel whose light has the largest mean distance.
size_t farthest_channel(const std::vector<Around>& around) {
    std::array<double, 3> mean = {};
    for (const Around& here : around)
        for (size_t c = 0; c < 3; ++c) mean[c] += here.light[c] * here.radius_mm * here.radius_mm;
    return size_t(std::ranges::max_element(mean) - mean.begin());
}

}  // namespace

// The angle's integral over the disk's points at distance t is a Bessel function (Rice 1945).
double gaussian_over_disk(double variance_mm2, double disk_radius_mm, double distance_mm) {
    double sum = 0;
    for (int i = 0; i < kDiskSteps; ++i) {
        const double t = disk_radius_mm * (i + 0.5) / kDiskSteps, away = distance_mm - t;
        sum +=
            t * std::exp(-0.5 * away * away / variance_mm2) * scaled_bessel_0(distance_mm * t / variance_mm2);
    }
    const double step = disk_radius_mm / kDiskSteps;
    return sum * step / variance_mm2 / (std::numbers::pi * disk_radius_mm * disk_radius_mm);
}

std::vector<ShadowTap> shadow_taps(const GaussianSum& profile) {
    const std::vector<Around> around = light_around(profile);
    const size_t channel = farthest_channel(around);
    double whole = 0;
    for (const Around& here : around) whole += here.light[channel] * here.radius_mm;
    std::vector<ShadowTap> taps;
    double up_to = 0, penumbra = 0;
    for (const Around& here : around) {
        up_to += here.light[channel] * here.radius_mm;
        while (taps.size() < size_t(kShadowGatherTaps) &&
               up_to >= whole * (double(taps.size()) + 0.5) / kShadowGatherTaps) {
            ShadowTap tap = {.penumbra_weight = here.penumbra / here.light[channel],
                             .radius_mm = here.radius_mm};
            for (size_t c = 0; c < 3; ++c) tap.weight[c] = here.light[c] / here.light[channel];
            taps.push_back(tap);
            penumbra += tap.penumbra_weight / kShadowGatherTaps;
        }
    }
    for (ShadowTap& tap : taps) tap.penumbra_weight /= penumbra;
    return taps;
}

}  // namespace dermis::preintegrated
