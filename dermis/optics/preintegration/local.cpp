// Narrow lobes. With f(t) = max(0, t) and the Laplacian of the unit sphere, (Laplacian + 2) f = delta(t): a
// clamped cosine is the field of a line source on the terminator. Blurring commutes with the Laplacian, so F
// solves (Laplacian + 2) F = kappa I_0(kappa sqrt(1 - t^2)) / (2 sinh kappa), the lobe's density on that
// line, and variation of parameters with the solutions t and 1 - t atanh t gives, in closed form but for one
// integral,
//     F(t) = t (rho_1 / 2 + J(t)) + (1 - t atanh t) c I_1(kappa c) / (2 sinh kappa),   c = sqrt(1 - t^2),
//     J(t) = kappa / (2 sinh kappa) * int_0^t (1 - s atanh s) I_0(kappa sqrt(1 - s^2)) ds.
// On the ring the same argument (F'' + F = lobe) needs int cos(y) exp(-kappa (1 - cos y)) dy instead. In the
// chord w = 2 sin(y/2) both integrands are exp(-kappa w^2 / 2) times a power series in w^2, and
//     int_0^W w^(2k) e^(-kappa w^2 / 2) dw = ((2k - 1) [k - 1] - W^(2k-1) e^(-kappa W^2 / 2)) / kappa
// reduces them to one error function and a polynomial.

#include "dermis/optics/preintegration/local.h"

#include <algorithm>
#include <cassert>

namespace dermis::inline optics::preintegration {
namespace {

constexpr int kOrder = LocalTail::kOrder;
constexpr int kBesselTerms = 8;
using Series = std::array<double, kOrder>;  // powers of x = w^2

Series product(const Series& a, const Series& b) {
    Series out = {};
    for (int i = 0; i < kOrder; ++i)
        for (int j = 0; i + j < kOrder; ++j) out[i + j] += a[i] * b[j];
    return out;
}

// (1 - x / divisor)^power
Series binomial(double power, double divisor) {
    Series out = {1};
    for (int k = 1; k < kOrder; ++k) out[k] = out[k - 1] * -(power - k + 1) / (k * divisor);
    return out;
}

// 1 - s atanh s with s^2 = x - x^2 / 4
Series one_less_s_atanh_s() {
    Series out = {1};
    const Series s_squared = {0, 1, -0.25};
    Series power = s_squared;
    for (int k = 0; k + 1 < kOrder; ++k) {
        for (int i = 0; i < kOrder; ++i) out[i] -= power[i] / (2 * k + 1);
        power = product(power, s_squared);
    }
    return out;
}

// The sphere's two power series for each power of 1 / kappa in the expansions of the Bessel functions.
struct SphereSeries {
    std::array<Series, kBesselTerms> integrand, source;
    SphereSeries() {
        const Series weight = one_less_s_atanh_s();
        for (int m = 0; m < kBesselTerms; ++m) {
            // c = 1 - x/2 to the power 1/2 - m: from I_0, with ds = c dw / sqrt(1 - w^2/4).
            const Series common = product(weight, binomial(0.5 - m, 2));
            integrand[m] = product(common, binomial(-0.5, 4));
            source[m] = common;
            for (double& value : integrand[m]) value *= bessel_asymptotic_coefficient(0, m);
            for (double& value : source[m]) value *= bessel_asymptotic_coefficient(1, m);
        }
    }
};

Series horner(const std::array<Series, kBesselTerms>& terms, double inverse, double scale) {
    Series sum = {};
    for (int m = kBesselTerms - 1; m >= 0; --m)
        for (int i = 0; i < kOrder; ++i) sum[i] = sum[i] * inverse + terms[m][i];
    for (double& value : sum) value *= scale;
    return sum;
}

// Coefficients of Q in int_0^W h(w^2) e^(-kappa w^2/2) dw = const * erf - W e^(-kappa W^2/2) Q(W^2).
Series partial_integration(const Series& h, double concentration) {
    Series q = {};
    double above = 0;
    for (int j = kOrder - 2; j >= 0; --j) {
        above = (h[j + 1] + (2 * j + 3) * above) / concentration;
        q[j] = above;
    }
    return q;
}

}  // namespace

LocalTail::LocalTail(Construction construction, double concentration)
    : concentration_(concentration), half_mean_cosine_(0.5 * lobe(construction, concentration).mean_cosine) {
    assert(concentration >= kSwitchConcentration && std::isfinite(concentration));
    if (construction == Construction::sphere) {
        static const SphereSeries series;
        const double inverse = 1 / concentration;
        const double bessel_scale = 1 / std::sqrt(2 * std::numbers::pi * concentration);
        source_ = horner(series.source, inverse, bessel_scale);
        integral_ = partial_integration(horner(series.integrand, inverse, concentration * bessel_scale),
                                        concentration);
        return;
    }
    static const Series integrand = product({1, -0.5}, binomial(-0.5, 4));
    const double scale = 0.5 / lobe(construction, concentration).mass;
    source_ = {scale / concentration, -0.5 * scale / concentration};
    integral_ = partial_integration(integrand, concentration);
    for (double& value : integral_) value *= scale;
}

double LocalTail::operator()(double sine, double x) const {
    const double exponent = 0.5 * concentration_ * x;
    if (exponent > kReach) return 0;
    double source = 0, integral = 0;
    for (int k = kOrder - 1; k >= 0; --k) {
        source = source * x + source_[k];
        integral = integral * x + integral_[k];
    }
    return std::exp(-exponent) * (source - sine * std::sqrt(x) * integral) -
           sine * half_mean_cosine_ * std::erfc(std::sqrt(exponent));
}

}  // namespace dermis::inline optics::preintegration
