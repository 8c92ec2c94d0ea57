#include "techniques/texture_space/blur_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "dermis/optics/blur_waves.h"
#include "techniques/texture_space/constants.h"

namespace dermis::texture_space {
namespace {

constexpr double kLeastShare = 0.01;

using Curve = WaveCurve;

// The taps of blur_mm.frag at one distance from the centre, in radii, and their part of all taps' weight.
struct TapRing {
    double distance = 1, weight = 1;
};
constexpr TapRing kRings[] = {{1, 2.0 / 3}, {std::numbers::sqrt2, 1.0 / 3}};

// Along one axis, at radius 1.
double ring_variance() {
    double sum = 0;
    for (const TapRing& ring : kRings) sum += ring.weight * ring.distance * ring.distance / 2;
    return sum;
}

// What the profile leaves of the waves in each colour.
struct Target {
    Curve x;
    std::array<Curve, 3> kept;
};

Target target_of(const GaussianSum& profile, double texel_mm) {
    Target target{.x = blur_waves(profile, texel_mm), .kept = {}};
    for (size_t i = 0; i < kBlurWaves; ++i) {
        const Vec3 t = profile_transfer(profile, target.x[i]);
        target.kept[0][i] = t.x, target.kept[1][i] = t.y, target.kept[2][i] = t.z;
    }
    return target;
}

// What reading between texels leaves of a wave.
double read_transfer(const BlurFitSettings& settings, double x) {
    return std::exp(-double(kBilinearVariance) * settings.texel_mm * settings.texel_mm * x);
}

// What the mean of the taps leaves: a ring of radius r turns a wave of frequency f into J0(2 pi f r) of it,
// as a mean over the wave's directions.
double taps_transfer(double radius_mm, const BlurFitSettings& settings, double x) {
    double sum = 0;
    for (const TapRing& ring : kRings)
        sum += ring.weight * ::j0(ring.distance * radius_mm * std::sqrt(2 * x));
    return sum * read_transfer(settings, x);
}

double squared_error(const Curve& kept, const Curve& target) {
    double sum = 0;
    for (size_t i = 0; i < kBlurWaves; ++i) {
        const double error = wave_importance(target[i]) * (kept[i] - target[i]);
        sum += error * error;
    }
    return sum;
}

// Least squares of one colour's shares, one after the other: the product is linear in each.
double fit_shares(const Curve& target, const std::vector<Curve>& taps, std::vector<double>& shares) {
    constexpr int kRounds = 12;
    const auto product_without = [&](size_t left_out) {
        Curve product;
        product.fill(1);
        for (size_t k = 0; k < taps.size(); ++k)
            for (size_t i = 0; k != left_out && i < kBlurWaves; ++i)
                product[i] *= 1 - shares[k] + shares[k] * taps[k][i];
        return product;
    };
    for (int round = 0; round < kRounds; ++round)
        for (size_t k = 0; k < taps.size(); ++k) {
            const Curve others = product_without(k);
            double above = 0, below = 1e-12;
            for (size_t i = 0; i < kBlurWaves; ++i) {
                const double importance = wave_importance(target[i]);
                const double slope = importance * others[i] * (1 - taps[k][i]);
                above += importance * (others[i] - target[i]) * slope;
                below += slope * slope;
            }
            shares[k] = std::clamp(above / below, 0.0, 1.0);
        }
    return squared_error(product_without(taps.size()), target);
}

struct Fit {
    std::vector<double> radii_mm;
    std::array<std::vector<double>, 3> shares;
    double error = std::numeric_limits<double>::infinity();
};

Fit fit_at(std::vector<double> radii_mm, const Target& target, const BlurFitSettings& settings) {
    Fit fit{.radii_mm = std::move(radii_mm), .error = 0};
    std::vector<Curve> taps;
    for (const double radius_mm : fit.radii_mm) {
        taps.emplace_back();
        for (size_t i = 0; i < kBlurWaves; ++i)
            taps.back()[i] = taps_transfer(radius_mm, settings, target.x[i]);
    }
    for (size_t c = 0; c < 3; ++c) {
        fit.shares[c].assign(taps.size(), 0.5);
        fit.error += fit_shares(target.kept[c], taps, fit.shares[c]);
    }
    return fit;
}

}  // namespace

Vec3 blur_transfer(const std::vector<BlurPass>& passes, const BlurFitSettings& settings, double x) {
    Vec3 product = {1, 1, 1};
    for (const BlurPass& pass : passes) {
        const auto taps = float(taps_transfer(double(pass.radius), settings, x));
        product = product * (Vec3{1, 1, 1} - pass.share * (1 - taps));
    }
    return product;
}

std::vector<BlurPass> fit_blur(const GaussianSum& profile, const BlurFitSettings& settings) {
    if (profile.terms.empty() || settings.passes <= 0) return {};
    const Target target = target_of(profile, settings.texel_mm);
    const double widest = std::sqrt(
        std::ranges::max(profile.terms, {}, &GaussianTerm::variance_mm2).variance_mm2 / ring_variance());
    Fit best;
    for (double last = widest; last > 0.2 * widest; last *= 0.8)
        for (const double ratio : {1.5, 1.8, 2.1, 2.5, 3.0, 3.6}) {
            std::vector<double> radii_mm(size_t(settings.passes), last);
            for (size_t i = radii_mm.size() - 1; i-- > 0;) radii_mm[i] = radii_mm[i + 1] / ratio;
            Fit fit = fit_at(std::move(radii_mm), target, settings);
            if (fit.error < best.error) best = std::move(fit);
        }
    std::vector<BlurPass> passes;
    for (size_t i = 0; i < best.radii_mm.size(); ++i) {
        const std::array<double, 3> share = {best.shares[0][i], best.shares[1][i], best.shares[2][i]};
        if (std::ranges::max(share) < kLeastShare) continue;
        passes.push_back({float(best.radii_mm[i]), {float(share[0]), float(share[1]), float(share[2])}});
    }
    return passes;
}

}  // namespace dermis::texture_space
