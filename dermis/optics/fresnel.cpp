#include "dermis/optics/fresnel.h"

#include <algorithm>
#include <cmath>

namespace dermis::inline optics {

double fresnel_dielectric(double cos_theta, double eta) {
    const double cos_i = std::clamp(cos_theta, 0.0, 1.0);
    const double sin2_t = (1 - cos_i * cos_i) / (eta * eta);  // Snell
    if (sin2_t >= 1) return 1;
    const double cos_t = std::sqrt(1 - sin2_t);
    const double parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    const double perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

double fresnel_schlick(double cos_theta, double f0) {
    const double m = 1 - std::clamp(cos_theta, 0.0, 1.0);
    return f0 + (1 - f0) * m * m * m * m * m;
}

double f0_of_eta(double eta) {
    const double root = (eta - 1) / (eta + 1);
    return root * root;
}

double diffuse_internal_reflectance(double eta) {
    return -1.440 / (eta * eta) + 0.710 / eta + 0.668 + 0.0636 * eta;
}

double diffuse_external_reflectance(double eta) {
    // Midpoint rule in cos^2: the integrand is smooth except for a square root at grazing angles.
    constexpr int kSteps = 20000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) sum += fresnel_dielectric(std::sqrt((i + 0.5) / kSteps), eta);
    return sum / kSteps;
}

}  // namespace dermis::inline optics
