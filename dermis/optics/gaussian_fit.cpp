// Levenberg-Marquardt on the share of light beyond r. Parameters per term: log variance, and a weight as the
// share of a softmax, so that weights are positive and sum to one at every step.

#include "dermis/optics/gaussian_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace dermis::inline optics {
namespace {

constexpr int kFitSamples = 200;
constexpr int kMaxIterations = 120;

struct Samples {
    std::vector<double> half_r_squared;  // r^2 / 2, so that a Gaussian's share beyond r is exp(-this / v)
    std::vector<double> beyond;          // 1 - cdf(r)
    std::vector<double> importance;      // of the squared error; starts at 1
};

// Log variances first, then logits.
using Parameters = std::vector<double>;

std::vector<double> softmax(const Parameters& p) {
    const size_t terms = p.size() / 2;
    const double largest = *std::max_element(p.begin() + long(terms), p.end());
    std::vector<double> share(terms);
    double sum = 0;
    for (size_t i = 0; i < terms; ++i) sum += share[i] = std::exp(p[terms + i] - largest);
    for (double& s : share) s /= sum;
    return share;
}

double model(const Parameters& p, const std::vector<double>& share, double half_r_squared) {
    double beyond = 0;
    for (size_t i = 0; i < share.size(); ++i)
        beyond += share[i] * std::exp(-half_r_squared * std::exp(-p[i]));
    return beyond;
}

double squared_error(const Parameters& p, const Samples& samples) {
    const std::vector<double> share = softmax(p);
    double sum = 0;
    for (size_t k = 0; k < samples.beyond.size(); ++k) {
        const double error = model(p, share, samples.half_r_squared[k]) - samples.beyond[k];
        sum += samples.importance[k] * error * error;
    }
    return sum;
}

// The lower triangle of the matrix, and the right-hand side.
struct NormalEquations {
    Eigen::MatrixXd matrix;
    Eigen::VectorXd right;
};

NormalEquations normal_equations(const Parameters& p, const Samples& samples) {
    const size_t n = p.size(), terms = n / 2;
    const std::vector<double> share = softmax(p);
    NormalEquations out{Eigen::MatrixXd::Zero(long(n), long(n)), Eigen::VectorXd::Zero(long(n))};
    Eigen::VectorXd gradient(n);
    std::vector<double> beyond(terms), inverse_variance(terms);
    for (size_t i = 0; i < terms; ++i) inverse_variance[i] = std::exp(-p[i]);
    for (size_t k = 0; k < samples.beyond.size(); ++k) {
        double value = 0;
        for (size_t i = 0; i < terms; ++i) {
            beyond[i] = std::exp(-samples.half_r_squared[k] * inverse_variance[i]);
            value += share[i] * beyond[i];
        }
        for (size_t i = 0; i < terms; ++i) {
            gradient[long(i)] = share[i] * beyond[i] * samples.half_r_squared[k] * inverse_variance[i];
            gradient[long(terms + i)] = share[i] * (beyond[i] - value);
        }
        out.right -= samples.importance[k] * (value - samples.beyond[k]) * gradient;
        out.matrix.selfadjointView<Eigen::Lower>().rankUpdate(gradient, samples.importance[k]);
    }
    return out;
}

// Solves (A + damping diag(A)) x = b. The small number on the diagonal keeps it definite along the direction
// that does not change the softmax.
Eigen::VectorXd damped_step(NormalEquations equations, double damping) {
    equations.matrix.diagonal().array() *= 1 + damping;
    equations.matrix.diagonal().array() += 1e-14;
    return equations.matrix.llt().solve(equations.right);
}

void minimise(Parameters& p, const Samples& samples, int iterations) {
    double damping = 1e-3, error = squared_error(p, samples);
    for (int i = 0; i < iterations && damping < 1e9; ++i) {
        const NormalEquations equations = normal_equations(p, samples);
        for (; damping < 1e9; damping *= 4) {
            const Eigen::VectorXd step = damped_step(equations, damping);
            Parameters tried = p;
            // Variances change by a factor of e^2 at most: beyond that the linear model is not valid.
            for (size_t k = 0; k < p.size(); ++k) tried[k] += std::clamp(step[long(k)], -2.0, 2.0);
            const double tried_error = squared_error(tried, samples);
            if (!(tried_error < error)) continue;
            const bool settled = error - tried_error < 1e-9 * error;
            p = tried, error = tried_error, damping = std::max(1e-9, damping / 6);
            if (settled) return;
            break;
        }
    }
}

double largest_error(const Parameters& p, const Samples& samples) {
    const std::vector<double> share = softmax(p);
    double largest = 0;
    for (size_t k = 0; k < samples.beyond.size(); ++k)
        largest = std::max(largest, std::abs(model(p, share, samples.half_r_squared[k]) - samples.beyond[k]));
    return largest;
}

// Lawson 1961: raising the importance where the error is large turns least squares into the smallest maximum.
Parameters level_errors(Parameters p, Samples samples) {
    Parameters best = p;
    double best_error = largest_error(p, samples);
    for (int round = 0; round < 12; ++round) {
        const std::vector<double> share = softmax(p);
        double sum = 0;
        for (size_t k = 0; k < samples.beyond.size(); ++k) {
            const double error = std::abs(model(p, share, samples.half_r_squared[k]) - samples.beyond[k]);
            sum += samples.importance[k] *= 0.1 * best_error + error;
        }
        for (double& importance : samples.importance) importance *= double(samples.importance.size()) / sum;
        minimise(p, samples, 8);
        if (const double error = largest_error(p, samples); error < best_error) best = p, best_error = error;
    }
    return best;
}

Samples sample(const Profile& profile, int channel) {
    const double nearest = std::max(inverse_cdf_mm(profile, channel, 0.001), 1e-9);
    const double farthest = std::max(inverse_cdf_mm(profile, channel, 0.9999), nearest * 1.01);
    Samples samples;
    for (int k = 0; k < kFitSamples; ++k) {
        const double r = nearest * std::pow(farthest / nearest, k / double(kFitSamples - 1));
        samples.half_r_squared.push_back(r * r / 2);
        samples.beyond.push_back(1 - cdf(profile, channel, r));
        samples.importance.push_back(1);
    }
    return samples;
}

// Starts from geometric series of variances between the radii of two percentiles.
Parameters fit_channel(const Profile& profile, int channel, const Samples& samples, int terms) {
    constexpr double kLadders[][2] = {{0.02, 0.99}, {0.05, 0.97}, {0.1, 0.999}, {0.3, 0.9}};
    Parameters best;
    double best_error = 0;
    for (const auto& [low, high] : kLadders) {
        const double r0 = std::max(inverse_cdf_mm(profile, channel, low), 1e-9);
        const double r1 = std::max(inverse_cdf_mm(profile, channel, high), r0 * 1.01);
        Parameters p(size_t(terms) * 2, 0.0);
        for (int i = 0; i < terms; ++i) {
            const double t = terms == 1 ? 0.5 : i / double(terms - 1);
            p[size_t(i)] = std::log(r0 * r0 / 2) + t * 2 * std::log(r1 / r0);
        }
        minimise(p, samples, kMaxIterations);
        const double error = largest_error(p, samples);
        if (best.empty() || error < best_error) best = p, best_error = error;
    }
    return level_errors(best, samples);
}

}  // namespace

GaussianFit to_gaussian_sum(const Profile& profile, int terms_per_channel) {
    assert(terms_per_channel >= 1 && terms_per_channel <= kMaxGaussianFitTerms);
    if (const auto* exact = std::get_if<GaussianSum>(&profile.model)) return {.sum = *exact};
    GaussianFit fit{.sum = {.name = profile.name + " (fit)"}};
    for (int c = 0; c < 3; ++c) {
        const double albedo = diffuse_albedo(profile, c);
        if (albedo <= 0) continue;
        const Samples samples = sample(profile, c);
        const Parameters p = fit_channel(profile, c, samples, terms_per_channel);
        const std::vector<double> share = softmax(p);
        for (size_t i = 0; i < share.size(); ++i) {
            GaussianTerm term{.variance_mm2 = std::exp(p[i]), .weight = {0, 0, 0}};
            term.weight[size_t(c)] = albedo * share[i];
            fit.sum.terms.push_back(term);
        }
        fit.max_error[size_t(c)] = largest_error(p, samples);
        fit.rms_error[size_t(c)] = std::sqrt(squared_error(p, samples) / kFitSamples);
    }
    std::ranges::sort(fit.sum.terms, {}, &GaussianTerm::variance_mm2);
    return fit;
}

}  // namespace dermis::inline optics
