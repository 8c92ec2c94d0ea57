#include "dermis/optics/microfacet.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dermis::inline optics {
namespace {

using std::numbers::pi;

// tan^2 of the angle whose cosine this is; infinite at grazing angles.
double tan2_of(double cosine) {
    const double cos2 = cosine * cosine;
    return (1 - std::min(cos2, 1.0)) / cos2;
}

// Smith's Lambda: the ratio of hidden to visible facet area towards a direction.
double ggx_lambda(double cosine, double alpha) {
    return 0.5 * (std::sqrt(1 + alpha * alpha * tan2_of(cosine)) - 1);
}

double beckmann_lambda(double cosine, double alpha) {
    const double a = 1 / (alpha * std::sqrt(tan2_of(cosine)));
    if (!std::isfinite(a)) return 0;  // normal incidence hides nothing
    return 0.5 * (std::exp(-a * a) / (a * std::sqrt(pi)) - std::erfc(a));
}

}  // namespace

double ggx_d(double n_dot_h, double alpha) {
    if (n_dot_h <= 0) return 0;
    const double a2 = alpha * alpha, c2 = std::min(n_dot_h * n_dot_h, 1.0);
    const double denominator = c2 * a2 + (1 - c2);
    return a2 / (pi * denominator * denominator);
}

double beckmann_d(double n_dot_h, double alpha) {
    if (n_dot_h <= 0) return 0;
    const double a2 = alpha * alpha, c2 = n_dot_h * n_dot_h;
    return std::exp(-tan2_of(n_dot_h) / a2) / (pi * a2 * c2 * c2);
}

double blinn_phong_d(double n_dot_h, double exponent) {
    if (n_dot_h <= 0) return 0;
    return (exponent + 2) / (2 * pi) * std::pow(std::min(n_dot_h, 1.0), exponent);
}

double blinn_phong_exponent(double alpha) {
    return std::max(0.0, 2 / (alpha * alpha) - 2);
}

double ggx_smith_g1(double n_dot_v, double alpha) {
    return n_dot_v <= 0 ? 0 : 1 / (1 + ggx_lambda(n_dot_v, alpha));
}

double beckmann_smith_g1(double n_dot_v, double alpha) {
    return n_dot_v <= 0 ? 0 : 1 / (1 + beckmann_lambda(n_dot_v, alpha));
}

double ggx_smith_g(double n_dot_l, double n_dot_v, double alpha) {
    if (n_dot_l <= 0 || n_dot_v <= 0) return 0;
    return 1 / (1 + ggx_lambda(n_dot_l, alpha) + ggx_lambda(n_dot_v, alpha));
}

double beckmann_smith_g(double n_dot_l, double n_dot_v, double alpha) {
    if (n_dot_l <= 0 || n_dot_v <= 0) return 0;
    return 1 / (1 + beckmann_lambda(n_dot_l, alpha) + beckmann_lambda(n_dot_v, alpha));
}

double microfacet_brdf(double d, double g, double fresnel, double n_dot_l, double n_dot_v) {
    if (n_dot_l <= 0 || n_dot_v <= 0) return 0;
    return d * g * fresnel / (4 * n_dot_l * n_dot_v);
}

double kelemen_szirmay_kalos_brdf(double d, double fresnel, double l_dot_h) {
    if (l_dot_h <= 0) return 0;
    return d * fresnel / (4 * l_dot_h * l_dot_h);
}

double oren_nayar(double n_dot_l, double n_dot_v, double l_dot_v, double sigma_rad) {
    if (n_dot_l <= 0 || n_dot_v <= 0) return 0;
    const double sigma2 = sigma_rad * sigma_rad;
    const double a = 1 - 0.5 * sigma2 / (sigma2 + 0.33);
    const double b = 0.45 * sigma2 / (sigma2 + 0.09);
    // l.v = n.l n.v + sin sin cos(phi), and sin(larger angle) tan(smaller angle) = sin sin / larger cosine.
    const double sines_cos_phi = l_dot_v - n_dot_l * n_dot_v;
    return a + b * std::max(0.0, sines_cos_phi) / std::max(n_dot_l, n_dot_v);
}

}  // namespace dermis::inline optics
