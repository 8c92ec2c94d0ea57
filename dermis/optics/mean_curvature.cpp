#include "dermis/optics/mean_curvature.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace dermis::inline optics {
namespace {

constexpr Eigen::Index kSamples = 200;
// Errors of smaller curvatures count as parts of this one.
constexpr double kSmallestPerMm = 0.05;

double polynomial(const MeanCurvature& form, double u) {
    double sum = 0;
    for (size_t i = kMeanCurvatureTerms; i-- > 0;) sum = u * (form.terms[i] + sum);
    return sum;
}

}  // namespace

MeanCurvature fit_mean_curvature(const GaussianSum& profile, size_t channel) {
    Eigen::MatrixXd basis(kSamples, Eigen::Index(kMeanCurvatureTerms));
    Eigen::VectorXd target(kSamples), weight(kSamples), place(kSamples);
    for (Eigen::Index i = 0; i < kSamples; ++i) {
        const double root = double(i + 1) / double(kSamples), curvature = root * root;
        const double cosine = preintegrated_mean_cosine(profile, 1 / curvature, {})[channel];
        place[i] = std::sqrt(std::max(1 - cosine, 0.0));
        weight[i] = 1 / std::max(curvature, kSmallestPerMm);
        target[i] = curvature;
        double power = 1;
        for (Eigen::Index k = 0; k < basis.cols(); ++k) basis(i, k) = power *= place[i];
    }
    const Eigen::VectorXd x =
        (weight.asDiagonal() * basis).colPivHouseholderQr().solve(weight.asDiagonal() * target);
    MeanCurvature form;
    for (size_t k = 0; k < kMeanCurvatureTerms; ++k) form.terms[k] = x[Eigen::Index(k)];
    form.largest_u = place[kSamples - 1];
    for (Eigen::Index i = 0; i < kSamples; ++i)
        form.max_error =
            std::max(form.max_error, weight[i] * std::abs(polynomial(form, place[i]) - target[i]));
    return form;
}

double evaluate(const MeanCurvature& form, double mean_length) {
    return polynomial(form, std::min(std::sqrt(std::max(1 - mean_length, 0.0)), form.largest_u));
}

}  // namespace dermis::inline optics
