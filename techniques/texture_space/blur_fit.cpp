#include "techniques/texture_space/blur_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace dermis::texture_space {
namespace {

constexpr int kSamples = 24;
constexpr double kLeastShare = 0.01;

using Curve = std::array<double, kSamples>;
using Curves = std::array<Curve, 3>;

// Reading a texture between its texels spreads light like a Gaussian of this variance, in squares of a texel.
constexpr double kBilinearVariance = 1.0 / 6;

// Logarithmic steps from waves that the widest Gaussian hardly damps to those that the narrowest removes or
// that the texels cannot hold.
Curve samples_of(const GaussianSum& profile, double texel_mm) {
    const auto [narrowest, widest] = std::ranges::minmax(profile.terms, {}, &GaussianTerm::variance_mm2);
    const double first = 0.1 / widest.variance_mm2;
    const double nyquist = 4.93 / (texel_mm * texel_mm);  // 2 pi^2 / (2 texel)^2
    const double last = std::max(std::min(4 / narrowest.variance_mm2, nyquist), 10 * first);
    Curve x;
    for (size_t i = 0; i < kSamples; ++i) x[i] = first * std::pow(last / first, double(i) / (kSamples - 1));
    return x;
}

Curves target_of(const GaussianSum& profile, const Curve& x) {
    Curves target;
    for (size_t i = 0; i < kSamples; ++i) {
        const Vec3 t = profile_transfer(profile, x[i]);
        target[0][i] = t.x, target[1][i] = t.y, target[2][i] = t.z;
    }
    return target;
}

Curve damping(double variance_mm2, const Curve& x) {
    Curve curve;
    for (size_t i = 0; i < kSamples; ++i) curve[i] = std::exp(-variance_mm2 * x[i]);
    return curve;
}

// What reading between texels leaves of a wave.
double read_transfer(const BlurFitSettings& settings, double x) {
    return std::exp(-kBilinearVariance * settings.texel_mm * settings.texel_mm * x);
}

// What the mean of the taps leaves: a ring of radius r turns a wave of frequency f into J0(2 pi f r) of it,
// as a mean over the wave's directions.
double taps_transfer(double radius_mm, const BlurFitSettings& settings, double x) {
    double sum = 0;
    for (const TapRing& ring : settings.rings)
        sum += ring.weight * ::j0(ring.distance * radius_mm * std::sqrt(2 * x));
    return sum * read_transfer(settings, x);
}

double squared_error(const Curve& a, const Curve& b) {
    double sum = 0;
    for (size_t i = 0; i < kSamples; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

// Least squares of one colour's shares, one after the other: the product is linear in each.
double fit_shares(const Curve& target, const Curve& reading, const std::vector<Curve>& taps,
                  std::vector<double>& shares) {
    constexpr int kRounds = 12;
    const auto product_without = [&](size_t left_out) {
        Curve product = reading;
        for (size_t k = 0; k < taps.size(); ++k)
            for (size_t i = 0; k != left_out && i < kSamples; ++i)
                product[i] *= 1 - shares[k] + shares[k] * taps[k][i];
        return product;
    };
    for (int round = 0; round < kRounds; ++round)
        for (size_t k = 0; k < taps.size(); ++k) {
            const Curve others = product_without(k);
            double above = 0, below = 1e-12;
            for (size_t i = 0; i < kSamples; ++i) {
                const double slope = others[i] * (1 - taps[k][i]);
                above += (others[i] - target[i]) * slope;
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

Fit fit_at(std::vector<double> radii_mm, const Curves& target, const Curve& x,
           const BlurFitSettings& settings) {
    Fit fit{.radii_mm = std::move(radii_mm), .error = 0};
    std::vector<Curve> taps;
    for (const double radius_mm : fit.radii_mm) {
        taps.emplace_back();
        for (size_t i = 0; i < kSamples; ++i) taps.back()[i] = taps_transfer(radius_mm, settings, x[i]);
    }
    Curve reading;
    for (size_t i = 0; i < kSamples; ++i)
        reading[i] = settings.read_blurs ? read_transfer(settings, x[i]) : 1;
    for (size_t c = 0; c < 3; ++c) {
        fit.shares[c].assign(taps.size(), 0.5);
        fit.error += fit_shares(target[c], reading, taps, fit.shares[c]);
    }
    return fit;
}

}  // namespace

double tap_variance(const std::vector<TapRing>& rings) {
    double sum = 0;
    for (const TapRing& ring : rings) sum += ring.weight * ring.distance * ring.distance / 2;
    return sum;
}

Vec3 blur_transfer(const std::vector<BlurPass>& passes, const BlurFitSettings& settings, double x) {
    const float reading = settings.read_blurs ? float(read_transfer(settings, x)) : 1.0f;
    Vec3 product = {reading, reading, reading};
    for (const BlurPass& pass : passes) {
        const auto taps = float(taps_transfer(double(pass.radius), settings, x));
        product = product * (Vec3{1, 1, 1} - pass.share * (1 - taps));
    }
    return product;
}

std::vector<BlurPass> fit_blur(const GaussianSum& profile, const BlurFitSettings& settings) {
    if (profile.terms.empty() || settings.passes <= 0) return {};
    const Curve x = samples_of(profile, settings.texel_mm);
    const Curves target = target_of(profile, x);
    const auto radius_of = [&](double variance_mm2) {
        return std::sqrt(variance_mm2 / tap_variance(settings.rings));
    };
    const double widest =
        radius_of(std::ranges::max(profile.terms, {}, &GaussianTerm::variance_mm2).variance_mm2);
    Fit best;
    for (double last = widest; last > 0.2 * widest; last *= 0.8)
        for (const double ratio : {1.5, 1.8, 2.1, 2.5, 3.0, 3.6}) {
            std::vector<double> radii_mm(size_t(settings.passes), last);
            for (size_t i = radii_mm.size() - 1; i-- > 0;) radii_mm[i] = radii_mm[i + 1] / ratio;
            Fit fit = fit_at(std::move(radii_mm), target, x, settings);
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

int nearest_pass_count(const GaussianSum& profile, const std::vector<double>& variances_texels,
                       double texel_mm) {
    if (profile.terms.empty()) return 0;
    const Curve x = samples_of(profile, texel_mm);
    const Curves target = target_of(profile, x);
    double variance_texels = kBilinearVariance, best = std::numeric_limits<double>::infinity();
    int count = 0;
    for (size_t n = 0; n <= variances_texels.size(); ++n) {
        if (n > 0) variance_texels += variances_texels[n - 1];
        const Curve blurred = damping(variance_texels * texel_mm * texel_mm, x);
        double error = 0;
        for (const Curve& color : target) error += squared_error(blurred, color);
        if (error < best) best = error, count = int(n);
    }
    return count;
}

}  // namespace dermis::texture_space
