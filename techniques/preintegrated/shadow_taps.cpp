#include "techniques/preintegrated/shadow_taps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "dermis/bake/shadow_ramp.h"
#include "techniques/preintegrated/constants.h"

namespace dermis::preintegrated {
namespace {

// A tap cannot see a shadow's edge sharper.
constexpr double kNarrowestVariance_mm2 = 0.03;
constexpr int kRadialSteps = 512, kDiskSteps = 96;
constexpr double kReachInDeviations = 4;

// exp(-x) I0(x), of which the library's I0 overflows from x = 700.
double scaled_bessel_0(double x) {
    if (x < 50) return std::exp(-x) * std::cyl_bessel_i(0.0, x);
    return (1 + 1 / (8 * x) + 9 / (128 * x * x)) / std::sqrt(2 * std::numbers::pi * x);
}

struct Around {
    double radius_mm = 0;
    Rgb light = {};       // of each channel, integral 1 over the plane
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

// Its light has the largest mean distance.
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
