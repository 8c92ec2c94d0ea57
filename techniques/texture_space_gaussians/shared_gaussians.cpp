#include "techniques/texture_space_gaussians/shared_gaussians.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "dermis/optics/blur_waves.h"

namespace dermis::texture_space_gaussians {
namespace {

constexpr double kLeastShare = 0.01;

using Curve = WaveCurve;

double dot(const Curve& a, const Curve& b, const Curve& importance) {
    double sum = 0;
    for (size_t i = 0; i < kBlurWaves; ++i) sum += a[i] * b[i] * importance[i] * importance[i];
    return sum;
}

// What is taken of the waves: 1 - exp(-v x) of a Gaussian, 1 - T of the profile.
struct Target {
    Curve x;
    std::array<Curve, 3> taken, importance;
};

Target target_of(const GaussianSum& profile, double texel_mm) {
    Target target = {.x = blur_waves(profile, texel_mm), .taken = {}, .importance = {}};
    for (size_t i = 0; i < kBlurWaves; ++i) {
        const Vec3 kept = profile_transfer(profile, target.x[i]);
        target.taken[0][i] = 1 - kept.x, target.taken[1][i] = 1 - kept.y, target.taken[2][i] = 1 - kept.z;
        for (size_t c = 0; c < 3; ++c) target.importance[c][i] = wave_importance(1 - target.taken[c][i]);
    }
    return target;
}

struct Fit {
    std::vector<double> variances_mm2;
    std::vector<Vec3> shares;
    double error = std::numeric_limits<double>::infinity();
};

// Least squares of one colour's shares, which are not negative and sum to 1 with what stays as it is: the
// pair that gains most exchanges share until none gains (sequential minimal optimisation, Platt 1998).
// Returns the error.
double fit_shares(const Curve& taken, const Curve& importance, const std::vector<Curve>& bases,
                  std::vector<double>& shares) {
    constexpr int kMostExchanges = 400;
    constexpr double kLeastGain = 1e-7;
    // The last share is of light that stays as it is, of which nothing is taken: a basis of zeros.
    const size_t n = bases.size() + 1;
    std::vector<double> products(n * n, 0), slope(n, 0);  // of half the error
    for (size_t i = 0; i + 1 < n; ++i) {
        slope[i] = -dot(bases[i], taken, importance);
        for (size_t j = 0; j + 1 < n; ++j) products[i * n + j] = dot(bases[i], bases[j], importance);
    }
    const std::vector<double> start = slope;
    shares.assign(n, 0);
    shares.back() = 1;
    for (int exchange = 0; exchange < kMostExchanges; ++exchange) {
        size_t to = 0, from = n - 1;
        for (size_t i = 0; i < n; ++i) {
            if (slope[i] < slope[to]) to = i;
            if (shares[i] > 0 && (shares[from] <= 0 || slope[i] > slope[from])) from = i;
        }
        const double gain = slope[from] - slope[to];
        if (gain < kLeastGain) break;
        const double curvature =
            products[to * n + to] + products[from * n + from] - 2 * products[to * n + from];
        const double step = std::min(shares[from], gain / std::max(curvature, 1e-12));
        shares[to] += step, shares[from] -= step;
        for (size_t i = 0; i < n; ++i) slope[i] += step * (products[i * n + to] - products[i * n + from]);
    }
    double error = dot(taken, taken, importance);
    for (size_t i = 0; i < n; ++i) error += shares[i] * (start[i] + slope[i]);
    return error;
}

Fit fit_at(std::vector<double> variances_mm2, const Target& target) {
    Fit fit{.variances_mm2 = std::move(variances_mm2), .shares = {}, .error = 0};
    std::vector<Curve> bases(fit.variances_mm2.size());
    for (size_t k = 0; k < bases.size(); ++k)
        for (size_t i = 0; i < kBlurWaves; ++i)
            bases[k][i] = -std::expm1(-fit.variances_mm2[k] * target.x[i]);
    std::array<std::vector<double>, 3> shares;
    for (size_t c = 0; c < 3; ++c)
        fit.error += fit_shares(target.taken[c], target.importance[c], bases, shares[c]);
    for (size_t k = 0; k < bases.size(); ++k)
        fit.shares.push_back({float(shares[0][k]), float(shares[1][k]), float(shares[2][k])});
    return fit;
}

Fit best_series(int count, double widest_mm2, const Target& target) {
    Fit best;
    for (double last = 1.2 * widest_mm2; last > 0.02 * widest_mm2; last *= 0.7)
        for (const double ratio : {3.0, 5.0, 8.0, 12.0, 18.0}) {
            std::vector<double> variances(size_t(count), last);
            for (size_t k = variances.size() - 1; k-- > 0;) variances[k] = variances[k + 1] / ratio;
            if (Fit fit = fit_at(std::move(variances), target); fit.error < best.error) best = std::move(fit);
        }
    return best;
}

// Each variance in turn, by a factor that shrinks when none helps.
Fit moved(Fit best, const Target& target) {
    for (double factor = 1.5; factor > 1.01;) {
        bool better = false;
        for (size_t k = 0; k < best.variances_mm2.size(); ++k)
            for (const double by : {factor, 1 / factor}) {
                std::vector<double> variances = best.variances_mm2;
                variances[k] *= by;
                Fit fit = fit_at(std::move(variances), target);
                if (fit.error < 0.999 * best.error) best = std::move(fit), better = true;
            }
        if (!better) factor = std::sqrt(factor);
    }
    return best;
}

double largest_error(const Fit& fit, const Target& target) {
    double largest = 0;
    for (size_t i = 0; i < kBlurWaves; ++i) {
        Vec3 taken = {0, 0, 0};
        for (size_t k = 0; k < fit.shares.size(); ++k)
            taken += fit.shares[k] * float(-std::expm1(-fit.variances_mm2[k] * target.x[i]));
        const std::array<float, 3> colors = {taken.x, taken.y, taken.z};
        for (size_t c = 0; c < 3; ++c)
            largest =
                std::max(largest, std::abs(double(colors[c]) - target.taken[c][i]) * target.importance[c][i]);
    }
    return largest;
}

Fit smallest_fit(double widest_mm2, const Target& target) {
    Fit fit;
    for (int count = 1; count <= kMostSharedGaussians; ++count) {
        fit = moved(best_series(count, widest_mm2, target), target);
        if (largest_error(fit, target) < kSharedGaussiansError) break;
    }
    return fit;
}

}  // namespace

GaussianSum shared_gaussians(const GaussianSum& profile, double texel_mm) {
    GaussianSum shared{.name = profile.name, .terms = {}};
    if (profile.terms.empty()) return shared;
    const double widest_mm2 = std::ranges::max(profile.terms, {}, &GaussianTerm::variance_mm2).variance_mm2;
    if (!(widest_mm2 > 0)) return shared;
    const Fit fit = smallest_fit(widest_mm2, target_of(profile, texel_mm));
    Vec3 unblurred = {1, 1, 1};
    for (size_t k = 0; k < fit.shares.size(); ++k) {
        const Vec3 share = fit.shares[k];
        if (std::max({share.x, share.y, share.z}) < float(kLeastShare)) continue;
        unblurred = unblurred - share;
        shared.terms.push_back({.variance_mm2 = fit.variances_mm2[k],
                                .weight = {double(share.x), double(share.y), double(share.z)}});
    }
    if (std::max({unblurred.x, unblurred.y, unblurred.z}) > 0)
        shared.terms.push_back(
            {.variance_mm2 = 0, .weight = {double(unblurred.x), double(unblurred.y), double(unblurred.z)}});
    std::ranges::sort(shared.terms, {}, &GaussianTerm::variance_mm2);
    return shared;
}

}  // namespace dermis::texture_space_gaussians
