#include "dermis/optics/closed_form.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/base/text.h"

namespace dermis::inline optics {
namespace {

constexpr int kSamples = 64;

// |N.L| from 0 to 1, denser towards both ends, where E is curved most.
std::vector<double> sample_cosines() {
    std::vector<double> cosines;
    for (int i = 0; i <= kSamples; ++i)
        cosines.push_back(0.5 - 0.5 * std::cos(std::numbers::pi * double(i) / kSamples));
    return cosines;
}

struct EvenFit {
    double q = 0, s = 1, k0 = 0, k1 = 0;
    double error = 0;  // largest residual of E
};

// The linear part for one q.
EvenFit fit_linear(const std::vector<double>& cosines, const Eigen::VectorXd& even, double q) {
    Eigen::MatrixXd basis(Eigen::Index(cosines.size()), 3);
    for (Eigen::Index i = 0; i < basis.rows(); ++i) {
        const double t2 = cosines[size_t(i)] * cosines[size_t(i)];
        basis.row(i) << std::sqrt(q * q + t2), 1, t2;
    }
    const Eigen::Vector3d x = basis.colPivHouseholderQr().solve(even);
    return {q, x[0], x[1], x[2], (basis * x - even).cwiseAbs().maxCoeff()};
}

// For every profile tried the residual over log q has one minimum; a scan brackets it and a golden section
// finds it.
EvenFit fit_even(const std::vector<double>& cosines, const Eigen::VectorXd& even) {
    constexpr double kLow = -12, kHigh = 1, kStep = 0.5;
    const auto at = [&](double log_q) { return fit_linear(cosines, even, std::exp(log_q)); };
    double middle = kLow;
    EvenFit best = at(kLow);
    for (double log_q = kLow + kStep; log_q <= kHigh; log_q += kStep)
        if (const EvenFit fit = at(log_q); fit.error < best.error) best = fit, middle = log_q;
    double low = middle - kStep, high = middle + kStep;
    for (int i = 0; i < 18; ++i) {
        const double a = high - (high - low) / std::numbers::phi, b = low + (high - low) / std::numbers::phi;
        const EvenFit fit_a = at(a), fit_b = at(b);
        if (std::min(fit_a.error, fit_b.error) < best.error) best = fit_a.error < fit_b.error ? fit_a : fit_b;
        (fit_a.error < fit_b.error ? high : low) = fit_a.error < fit_b.error ? b : a;
    }
    return best;
}

// One curvature: D at all +-cosines splits into its odd part, known exactly, and its even part.
class RowFitter {
  public:
    explicit RowFitter(const Preintegration& how)
        : how_(how), cosines_(sample_cosines()), rows_(both_signs(), how) {}

    ClosedFormCoefficients fit(const GaussianSum& profile, double radius_mm) {
        const size_t count = cosines_.size();
        std::vector<double> rgb(3 * rows_.size());
        rows_.evaluate(profile, radius_mm, rgb);
        ClosedFormCoefficients row;
        row.a = preintegrated_mean_cosine(profile, radius_mm, how_);
        Eigen::VectorXd even(static_cast<Eigen::Index>(count));
        for (size_t c = 0; c < 3; ++c) {
            for (size_t i = 0; i < count; ++i)
                even[Eigen::Index(i)] = rgb[3 * i + c] + rgb[3 * (count + i) + c];
            const EvenFit fit = fit_even(cosines_, even);
            row.q[c] = fit.q, row.s[c] = fit.s, row.k0[c] = fit.k0, row.k1[c] = fit.k1;
            max_error_ = std::max(max_error_, fit.error / 2);  // D holds half of E
        }
        return row;
    }

    [[nodiscard]] double max_error() const { return max_error_; }

  private:
    [[nodiscard]] std::vector<double> both_signs() const {
        std::vector<double> all = cosines_;
        for (const double t : cosines_) all.push_back(-t);
        return all;
    }

    Preintegration how_;
    std::vector<double> cosines_;
    DiffuseRows rows_;
    double max_error_ = 0;
};

}  // namespace

Result<ClosedForm> fit_closed_form(const GaussianSum& profile, double max_curvature_per_mm, int row_count,
                                   const Preintegration& how) {
    DERMIS_TRY(check_preintegrable(profile));
    if (row_count < 2 || row_count > 65536)
        return Error{"closed form: " + std::to_string(row_count) + " rows; 2 to 65536"};
    if (!(max_curvature_per_mm > 0) || !std::isfinite(max_curvature_per_mm))
        return Error{"closed form: largest curvature " + to_text(max_curvature_per_mm) +
                     " per mm; more than 0"};
    ClosedForm form{.max_curvature_per_mm = max_curvature_per_mm};
    RowFitter fitter(how);
    const Rgb zero = {0, 0, 0}, one = {1, 1, 1};
    form.rows.push_back({one, zero, one, zero, zero});
    for (int i = 1; i < row_count; ++i)
        form.rows.push_back(fitter.fit(profile, (row_count - 1) / (max_curvature_per_mm * i)));
    form.max_error = fitter.max_error();
    return form;
}

Rgb evaluate(const ClosedForm& form, double n_dot_l, double curvature_per_mm) {
    const double last = double(form.rows.size() - 1);
    const double at = std::clamp(curvature_per_mm / form.max_curvature_per_mm, 0.0, 1.0) * last;
    const size_t low = std::min(size_t(at), form.rows.size() - 2);
    const ClosedFormCoefficients &p = form.rows[low], &q = form.rows[low + 1];
    const double t2 = n_dot_l * n_dot_l;
    Rgb d;
    for (size_t c = 0; c < 3; ++c) {
        const auto mixed = [&](const Rgb ClosedFormCoefficients::*member) {
            return std::lerp((p.*member)[c], (q.*member)[c], at - double(low));
        };
        const double corner = mixed(&ClosedFormCoefficients::q);
        const double even = mixed(&ClosedFormCoefficients::s) * std::sqrt(corner * corner + t2) +
                            mixed(&ClosedFormCoefficients::k0) + mixed(&ClosedFormCoefficients::k1) * t2;
        d[c] = 0.5 * (mixed(&ClosedFormCoefficients::a) * n_dot_l + even);
    }
    return d;
}

}  // namespace dermis::inline optics
