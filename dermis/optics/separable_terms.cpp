#include "dermis/optics/separable_terms.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

namespace dermis::inline optics {
namespace {

Eigen::VectorXd weights_of(const GaussianSum& profile, size_t channel) {
    Eigen::VectorXd weights(long(profile.terms.size()));
    for (size_t i = 0; i < profile.terms.size(); ++i)
        weights[long(i)] = std::max(profile.terms[i].weight[channel], 0.0);
    const double total = weights.sum();
    if (total > 0) weights /= total;
    return weights;
}

// <g(a), g(b)> = g(a + b, 0).
double inner_product(double a_mm2, double b_mm2) {
    return 1 / std::sqrt(2 * std::numbers::pi * (a_mm2 + b_mm2));
}

void fit_channel(const GaussianSum& profile, size_t channel, SeparableTerms& fit) {
    const Eigen::VectorXd root = weights_of(profile, channel).cwiseSqrt();
    const long n = root.size();
    Eigen::MatrixXd matrix(n, n);
    const auto seen = [&](long i) { return profile.terms[size_t(i)].variance_mm2 + kSeenMm * kSeenMm; };
    for (long i = 0; i < n; ++i)
        for (long j = 0; j < n; ++j) matrix(i, j) = root[i] * root[j] * inner_product(seen(i), seen(j));
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);  // smallest first
    const long kept = std::min(n, long(fit.terms.size()));
    const double all = solver.eigenvalues().squaredNorm();
    fit.error[channel] = all > 0 ? std::sqrt(solver.eigenvalues().head(n - kept).squaredNorm() / all) : 0;
    double light = 0;
    for (long k = 0; k < kept; ++k) {
        const double sum = solver.eigenvectors().col(n - 1 - k).dot(root);
        light += sum * sum;
    }
    if (!(light > 0)) return;  // no reflectance
    for (long k = 0; k < kept; ++k)
        for (long i = 0; i < n; ++i)
            fit.terms[size_t(k)].amplitude[size_t(i)][channel] =
                solver.eigenvectors()(i, n - 1 - k) * root[i] / std::sqrt(light);
}

}  // namespace

SeparableTerms separable_terms(const GaussianSum& profile, int count) {
    SeparableTerms fit;
    fit.terms.assign(size_t(count), {std::vector<Rgb>(profile.terms.size(), Rgb{})});
    for (size_t c = 0; c < 3; ++c) fit_channel(profile, c, fit);
    return fit;
}

}  // namespace dermis::inline optics
