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

double tap_variance_mm2(double radius_mm, const BlurFitSettings& settings) {
    return settings.tap_variance * radius_mm * radius_mm +
           kBilinearVariance * settings.texel_mm * settings.texel_mm;
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
    for (const double radius_mm : fit.radii_mm)
        taps.push_back(damping(tap_variance_mm2(radius_mm, settings), x));
    const Curve reading = damping(kBilinearVariance * settings.texel_mm * settings.texel_mm, x);
    for (size_t c = 0; c < 3; ++c) {
        fit.shares[c].assign(taps.size(), 0.5);
        fit.error += fit_shares(target[c], reading, taps, fit.shares[c]);
    }
    return fit;
}

}  // namespace

Vec3 profile_transfer(const GaussianSum& profile, double x) {
    double sum[3] = {0, 0, 0}, total[3] = {0, 0, 0};
    for (const GaussianTerm& term : profile.terms)
        for (size_t c = 0; c < 3; ++c) {
            sum[c] += term.weight[c] * std::exp(-term.variance_mm2 * x);
            total[c] += term.weight[c];
        }
    // A colour that the skin does not reflect is not blurred.
    const auto share = [&](int c) { return total[c] > 0 ? float(sum[c] / total[c]) : 1.0f; };
    return {share(0), share(1), share(2)};
}

Vec3 blur_transfer(const std::vector<BlurPass>& passes, const BlurFitSettings& settings, double x) {
    const auto reading = float(std::exp(-kBilinearVariance * settings.texel_mm * settings.texel_mm * x));
    Vec3 product = {reading, reading, reading};
    for (const BlurPass& pass : passes) {
        const auto taps = float(std::exp(-tap_variance_mm2(double(pass.radius), settings) * x));
        product = product * (Vec3{1, 1, 1} - pass.share * (1 - taps));
    }
    return product;
}

std::vector<BlurPass> fit_blur(const GaussianSum& profile, const BlurFitSettings& settings) {
    if (profile.terms.empty() || settings.passes <= 0) return {};
    const Curve x = samples_of(profile, settings.texel_mm);
    const Curves target = target_of(profile, x);
    const auto radius_of = [&](double variance_mm2) {
        return std::sqrt(variance_mm2 / settings.tap_variance);
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
