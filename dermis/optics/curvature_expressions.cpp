#include "dermis/optics/curvature_expressions.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace dermis::inline optics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr size_t kCurvatures = 40, kCosines = 20;
constexpr Index kTerms = Index(kExpressionTerms);
// On flat skin: sqrt(pi) / 2, sqrt(pi / 3), sqrt(5 pi) / 8.
constexpr double kLambertZonal[3] = {0.886226925452758, 1.023326707946488, 0.495415912200751};

double knee_coordinate(double curvature) {
    return curvature * (1 + kCurvatureKnee) / (curvature + kCurvatureKnee);
}

// u, u^2, ... u^6.
std::array<double, kExpressionTerms> powers_of(double u) {
    std::array<double, kExpressionTerms> result;
    double power = 1;
    for (double& value : result) value = power *= u;
    return result;
}

double sum_at(const CurvaturePolynomial& polynomial, size_t channel, double u) {
    double sum = 0;
    for (size_t i = kExpressionTerms; i-- > 0;) sum = u * (polynomial[i][channel] + sum);
    return sum;
}

VectorXd least_squares_of(const MatrixXd& basis, const VectorXd& target) {
    return basis.colPivHouseholderQr().solve(target);
}

// Samples of the fit: curvatures denser towards 0, N.L denser towards 0 and 1.
struct LitSamples {
    std::vector<double> curvatures, cosines;
    std::vector<VectorXd> even[3];  // D(t) + D(-t) by channel and curvature
    std::vector<Rgb> mean_cosine;
    std::vector<std::array<Rgb, 3>> zonal;
};

LitSamples sample_light(const GaussianSum& profile, const Preintegration& how) {
    LitSamples s;
    for (size_t j = 0; j < kCosines; ++j)
        s.cosines.push_back(0.5 - 0.5 * std::cos(std::numbers::pi * double(j) / (kCosines - 1)));
    std::vector<double> both_signs = s.cosines;
    for (const double t : s.cosines) both_signs.push_back(-t);
    const DiffuseRows rows(both_signs, how);
    std::vector<double> rgb(3 * rows.size());
    for (size_t i = 1; i <= kCurvatures; ++i) {
        const double root = double(i) / kCurvatures, curvature = root * root;
        s.curvatures.push_back(curvature);
        s.mean_cosine.push_back(preintegrated_mean_cosine(profile, 1 / curvature, how));
        s.zonal.push_back(preintegrated_zonal_harmonics(profile, 1 / curvature, how));
        rows.evaluate(profile, 1 / curvature, rgb);
        for (size_t c = 0; c < 3; ++c) {
            VectorXd even(static_cast<Index>(kCosines));
            for (size_t j = 0; j < kCosines; ++j)
                even[Index(j)] = rgb[3 * j + c] + rgb[3 * (kCosines + j) + c];
            s.even[c].push_back(std::move(even));
        }
    }
    return s;
}

// A polynomial in u through values over curvature; returns its errors.
template <class Value>
VectorXd fit_polynomial(const LitSamples& s, size_t channel, CurvaturePolynomial& polynomial, Value value) {
    MatrixXd basis(Index(kCurvatures), kTerms);
    VectorXd target(static_cast<Index>(kCurvatures));
    for (size_t i = 0; i < kCurvatures; ++i) {
        const auto power = powers_of(knee_coordinate(s.curvatures[i]));
        for (size_t k = 0; k < kExpressionTerms; ++k) basis(Index(i), Index(k)) = power[k];
        target[Index(i)] = value(i);
    }
    const VectorXd x = least_squares_of(basis, target);
    for (size_t k = 0; k < kExpressionTerms; ++k) polynomial[k][channel] = x[Index(k)];
    return (basis * x - target).cwiseAbs();
}

// s, k0 and k1 for one q(u) = k (q_0 + q_1 u), and the largest error of the even part.
class EvenPart {
  public:
    EvenPart(const LitSamples& samples, size_t channel) : s_(samples), channel_(channel) {}

    // Normal equations: many q are tried, and the result is refined by QR once.
    [[nodiscard]] double error(double q0, double q1) {
        fill(q0, q1);
        MatrixXd normal = basis_.transpose() * basis_;
        normal.diagonal().array() += 1e-12;
        x_ = normal.ldlt().solve(basis_.transpose() * target_);
        return (basis_ * x_ - target_).cwiseAbs().maxCoeff();
    }
    [[nodiscard]] VectorXd solve(double q0, double q1) {
        fill(q0, q1);
        x_ = least_squares_of(basis_, target_);
        return (basis_ * x_ - target_).cwiseAbs();
    }
    void store(CurvatureExpressions& form) const {
        CurvaturePolynomial* const parts[] = {&form.s, &form.k0, &form.k1};
        for (size_t part = 0; part < 3; ++part)
            for (size_t k = 0; k < kExpressionTerms; ++k)
                (*parts[part])[k][channel_] = x_[Index(part * kExpressionTerms + k)];
    }

  private:
    void fill(double q0, double q1) {
        basis_.resize(Index(kCurvatures * kCosines), 3 * kTerms);
        target_.resize(Index(kCurvatures * kCosines));
        Index row = 0;
        for (size_t i = 0; i < kCurvatures; ++i) {
            const double u = knee_coordinate(s_.curvatures[i]), q = s_.curvatures[i] * (q0 + q1 * u);
            const auto power = powers_of(u);
            for (size_t j = 0; j < kCosines; ++j, ++row) {
                const double t2 = s_.cosines[j] * s_.cosines[j], corner = std::sqrt(q * q + t2);
                target_[row] = s_.even[channel_][i][Index(j)] - corner;
                for (Index k = 0; k < kTerms; ++k) {
                    basis_(row, k) = power[size_t(k)] * corner;
                    basis_(row, kTerms + k) = power[size_t(k)];
                    basis_(row, 2 * kTerms + k) = power[size_t(k)] * t2;
                }
            }
        }
    }

    const LitSamples& s_;
    size_t channel_;
    MatrixXd basis_;
    VectorXd target_, x_;
};

// A scan over the corner's width, then smaller and smaller steps from its best. Returns the errors.
VectorXd fit_even_part(const LitSamples& samples, size_t channel, CurvatureExpressions& form) {
    EvenPart part(samples, channel);
    double best = 1e9, q0 = 1, q1 = 0;
    const auto attempt = [&](double a, double b) {
        const double error = part.error(a, b);
        if (error >= best) return false;
        best = error, q0 = a, q1 = b;
        return true;
    };
    for (double width = 0.02; width < 8; width *= 1.8)
        for (const double slope : {-0.5, 0.0, 0.5}) attempt(width, slope * width);
    for (double step = 0.3; step > 0.02;) {
        const double a = q0, b = q1;
        bool better = attempt(a * (1 + step), b) || attempt(a / (1 + step), b);
        better |= attempt(q0, q1 + step * q0) || attempt(q0, q1 - step * q0);
        if (!better) step /= 2;
    }
    const VectorXd errors = part.solve(q0, q1);
    part.store(form);
    form.q[0][channel] = q0, form.q[1][channel] = q1;
    return errors;
}

}  // namespace

Result<CurvatureExpressions> fit_curvature_expressions(const GaussianSum& profile,
                                                       const Preintegration& how) {
    DERMIS_TRY(check_preintegrable(profile));
    const LitSamples samples = sample_light(profile, how);
    CurvatureExpressions form;
    for (size_t c = 0; c < 3; ++c) {
        const VectorXd odd =
            fit_polynomial(samples, c, form.a, [&](size_t i) { return samples.mean_cosine[i][c] - 1; });
        const VectorXd even = fit_even_part(samples, c, form);
        for (size_t i = 0; i < kCurvatures; ++i)
            for (size_t j = 0; j < kCosines; ++j)  // D has half of both
                form.max_error = std::max(form.max_error, 0.5 * (odd[Index(i)] * samples.cosines[j] +
                                                                 even[Index(i * kCosines + j)]));
        for (size_t l = 0; l < 3; ++l)
            form.max_zonal_error =
                std::max(form.max_zonal_error, fit_polynomial(samples, c, form.zonal[l], [&](size_t i) {
                                                   return samples.zonal[i][l][c] - kLambertZonal[l];
                                               }).maxCoeff());
    }
    return form;
}

Rgb evaluate(const CurvatureExpressions& form, double n_dot_l, double curvature_per_mm) {
    const double k = std::clamp(curvature_per_mm, 0.0, 1.0), u = knee_coordinate(k), t2 = n_dot_l * n_dot_l;
    Rgb d;
    for (size_t c = 0; c < 3; ++c) {
        const double q = k * (form.q[0][c] + form.q[1][c] * u);
        d[c] =
            0.5 * ((1 + sum_at(form.a, c, u)) * n_dot_l + (1 + sum_at(form.s, c, u)) * std::sqrt(q * q + t2) +
                   sum_at(form.k0, c, u) + sum_at(form.k1, c, u) * t2);
    }
    return d;
}

std::array<Rgb, 3> evaluate_zonal(const CurvatureExpressions& form, double curvature_per_mm) {
    const double u = knee_coordinate(std::clamp(curvature_per_mm, 0.0, 1.0));
    std::array<Rgb, 3> zonal;
    for (size_t l = 0; l < 3; ++l)
        for (size_t c = 0; c < 3; ++c) zonal[l][c] = kLambertZonal[l] + sum_at(form.zonal[l], c, u);
    return zonal;
}

}  // namespace dermis::inline optics
