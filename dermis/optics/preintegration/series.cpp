// The spectral half of the baker. A lobe on a sphere multiplies every Legendre coefficient of the light by
// rho_l = I_{l+1/2}(kappa) / I_{1/2}(kappa) (Mardia, Jupp 2000, section 9.3.2), on a ring every Fourier
// coefficient by I_n / I_0; the clamped cosine has only even orders besides the first. What remains are the
// ratios of Bessel functions (a continued fraction, which is Miller's downward recurrence without its
// overflow) and, for the half ring, an integral that has to be split into a smooth part and the jump at its
// ends.

#include "dermis/optics/preintegration/series.h"

#include <algorithm>
#include <cassert>

namespace dermis::inline optics::preintegration {
namespace {

using std::numbers::pi;
constexpr double kNegligible = 1e-11;

size_t order_count(double concentration) {
    // rho_l falls like exp(-l (l + 1) / 2 kappa) when kappa is large, faster than kappa^l / (2l + 1)!! when
    // it is small.
    return std::min<size_t>(kMaxOrder + 1, size_t(12 + 8 * std::sqrt(concentration)));
}

void sphere_series(double concentration, EvenSeries& series) {
    std::array<double, kMaxOrder + 1> rho = {};
    const size_t orders = order_count(concentration);
    bessel_ratios(BesselOrders::half, concentration, std::span(rho).first(orders));
    // (2l+1)/2 times the moment of max(0,t) with P_l; the moments' ratio is -(l - 1) / (l + 4).
    double moment = 0.5;
    for (size_t l = 0; l < orders; l += 2) {
        series.coefficient[l / 2] = 0.5 * double(2 * l + 1) * moment * rho[l];
        moment *= (1 - double(l)) / double(l + 4);
    }
    series.count = (orders + 1) / 2;
}

void ring_series(double concentration, EvenSeries& series) {
    std::array<double, kMaxOrder + 1> ratio = {};
    const size_t orders = order_count(concentration);
    bessel_ratios(BesselOrders::whole, concentration, std::span(ratio).first(orders));
    series.coefficient[0] = 1 / pi;
    for (size_t n = 2; n < orders; n += 2)
        series.coefficient[n / 2] = -2 / pi * ratio[n] / (double(n) * double(n) - 1);
    series.count = (orders + 1) / 2;
}

// exp(-kappa) I_n(kappa) for n = 0, 1, ...: the ratios, normalised by exp(kappa) = I_0 + 2 sum I_n.
void scaled_bessels(double concentration, std::span<double> values) {
    bessel_ratios(BesselOrders::whole, concentration, values);
    double sum = -1;
    for (double ratio : values) sum += 2 * ratio;
    for (double& value : values) value /= sum;
}

// exp(-kappa) (I_0(kappa) - 1) / kappa without the cancellation at small kappa.
double scaled_i0_less_one_by(double concentration, double scaled_i0) {
    if (concentration > 2) return (scaled_i0 - std::exp(-concentration)) / concentration;
    double term = 0.25 * concentration, sum = 0;  // (kappa/2)^(2k) / k!^2 / kappa
    for (int k = 1; k < 16; ++k) {
        sum += term;
        term *= 0.25 * concentration * concentration / ((k + 1.0) * (k + 1.0));
    }
    return sum * std::exp(-concentration);
}

struct HalfRing {
    std::array<double, kMaxOrder + 2> scaled = {};
    size_t orders = 0;
    double mass = 0;    // integral of exp(-kappa (1 - cos x)) from 0 to pi/2
    double moment = 0;  // the same with cos x
};

HalfRing half_ring(double concentration) {
    HalfRing half;
    half.orders = order_count(concentration);
    scaled_bessels(concentration, std::span(half.scaled).first(half.orders + 1));
    half.mass = half.scaled[0] * pi / 2;
    half.moment = half.scaled[1] * pi / 2;
    double sign = 1;  // sin(n pi / 2) for odd n
    for (size_t n = 1; n < half.orders; n += 2, sign = -sign) {
        half.mass += 2 * sign * half.scaled[n] / double(n);
        half.moment += sign * (half.scaled[n - 1] + half.scaled[n + 1]) / double(n);
    }
    return half;
}

// With elevation b the lit part of the span is x in (-b, pi/2) and its integral has the antiderivatives
// C(x) = int cos e^{-kappa (1 - cos)} and e^{-kappa (1 - cos x)} / kappa. Their Fourier series, multiplied by
// sin b and cos b, leave one coefficient a cosine and the secular term b sin b.
void half_ring_series(double concentration, EvenSeries& series) {
    const HalfRing half = half_ring(concentration);
    const double scale = 0.5 / half.mass;
    series.coefficient[0] = half.scaled[1] * scale;
    series.coefficient[1] = half.scaled[0] * scale;
    series.coefficient[2] =
        (0.5 * half.scaled[1] + scaled_i0_less_one_by(concentration, half.scaled[0])) * scale;
    for (size_t m = 2; m < half.orders; ++m)
        series.coefficient[m + 1] = -2 * half.scaled[m] / (double(m) * double(m) - 1) * scale;
    series.count = half.orders + 1;
}

void even_legendre(double t, std::span<double> values) {
    double previous = 1, current = t;  // P_0, P_1
    values[0] = 1;
    for (size_t l = 1; l + 1 < 2 * values.size(); ++l) {
        const double next = (double(2 * l + 1) * t * current - double(l) * previous) / double(l + 1);
        previous = current;
        current = next;
        if (l % 2 == 1) values[(l + 1) / 2] = current;
    }
}

}  // namespace

void bessel_ratios(BesselOrders orders, double concentration, std::span<double> values) {
    std::ranges::fill(values, 0);
    values[0] = 1;
    if (concentration <= 0) return;
    // I_{nu+1} / I_nu = 1 / (2 (nu + 1) / kappa + I_{nu+2} / I_{nu+1}), from far above downwards.
    const double offset = orders == BesselOrders::half ? 0.5 : 0.0;
    const double twice_by_kappa = 2 / concentration;
    // The start value has no influence once the orders are well above sqrt(kappa).
    const size_t start = values.size() + 24 + size_t(8 * std::sqrt(concentration));
    double ratio = 0;
    for (size_t n = start; n >= 1; --n) {
        ratio = 1 / (twice_by_kappa * (double(n) + offset) + ratio);
        if (n < values.size()) values[n] = ratio;
    }
    for (size_t n = 1; n < values.size(); ++n) values[n] *= values[n - 1];
}

size_t basis_size(Construction construction) {
    return construction == Construction::half_ring ? kMaxOrder + 2 : kMaxOrder / 2 + 1;
}

void evaluate_basis(Construction construction, double t, std::span<double> values) {
    assert(values.size() == basis_size(construction));
    if (construction == Construction::sphere) return even_legendre(t, values);
    const double elevation = std::asin(std::clamp(t, -1.0, 1.0));
    if (construction == Construction::full_ring) {
        for (size_t k = 0; k < values.size(); ++k) values[k] = std::cos(2 * double(k) * elevation);
        return;
    }
    values[0] = elevation * std::sin(elevation);
    for (size_t m = 0; m + 1 < values.size(); ++m) values[m + 1] = std::cos(double(m) * elevation);
}

EvenSeries even_series(Construction construction, double concentration) {
    EvenSeries series;
    switch (construction) {
        case Construction::sphere:
            sphere_series(concentration, series);
            break;
        case Construction::full_ring:
            ring_series(concentration, series);
            break;
        case Construction::half_ring:
            half_ring_series(concentration, series);
            break;
    }
    while (series.count > 1 && std::abs(series.coefficient[series.count - 1]) < kNegligible) --series.count;
    return series;
}

double bessel_asymptotic_coefficient(double nu, int m) {
    double coefficient = 1;
    for (int k = 1; k <= m; ++k) coefficient *= -(4 * nu * nu - (2.0 * k - 1) * (2.0 * k - 1)) / (8.0 * k);
    return coefficient;
}

namespace {

using Asymptotic = std::array<double, 10>;

Asymptotic asymptotic(double nu) {
    Asymptotic coefficients;
    for (int m = 0; m < int(coefficients.size()); ++m) coefficients[m] = bessel_asymptotic_coefficient(nu, m);
    return coefficients;
}

double scaled_bessel(const Asymptotic& coefficients, double x) {
    const double inverse = 1 / x;
    double sum = 0;
    for (size_t m = coefficients.size(); m-- > 0;) sum = sum * inverse + coefficients[m];
    return sum * std::sqrt(inverse / (2 * pi));
}

double sphere_mean_cosine(double concentration) {
    if (concentration > 1) return 1 / std::tanh(concentration) - 1 / concentration;
    std::array<double, 2> rho = {};
    bessel_ratios(BesselOrders::half, concentration, rho);
    return rho[1];
}

}  // namespace

double scaled_bessel_i0(double concentration) {
    static const Asymptotic coefficients = asymptotic(0);
    return scaled_bessel(coefficients, concentration);
}

double scaled_bessel_i1(double concentration) {
    static const Asymptotic coefficients = asymptotic(1);
    return scaled_bessel(coefficients, concentration);
}

Lobe lobe(Construction construction, double concentration) {
    const bool narrow = concentration >= kSwitchConcentration;
    if (construction == Construction::sphere)
        return {sphere_mean_cosine(concentration), -std::expm1(-2 * concentration)};
    if (narrow) {
        const double i0 = scaled_bessel_i0(concentration);
        return {scaled_bessel_i1(concentration) / i0, pi * i0};
    }
    if (construction == Construction::half_ring) {
        const HalfRing half = half_ring(concentration);
        return {half.moment / half.mass, half.mass};
    }
    std::array<double, kMaxOrder + 1> scaled = {};
    scaled_bessels(concentration, scaled);
    return {scaled[1] / scaled[0], pi * scaled[0]};
}

}  // namespace dermis::inline optics::preintegration
