#include "techniques/screen_space_separable/kernel.h"

#include <algorithm>
#include <cmath>

#include "techniques/screen_space_separable/constants.h"

namespace dermis::screen_space_separable {

GaussianSum to_gaussian_sum(const TwoGaussians& kernel) {
    GaussianTerm near = {.variance_mm2 = double(kernel.near_mm) * kernel.near_mm};
    GaussianTerm far = {.variance_mm2 = double(kernel.far_mm) * kernel.far_mm};
    const float shares[3] = {kernel.far_share.x, kernel.far_share.y, kernel.far_share.z};
    for (size_t c = 0; c < 3; ++c) near.weight[c] = 1 - shares[c], far.weight[c] = shares[c];
    return {.name = "two_gaussians", .terms = {near, far}};
}

float reach_mm(const GaussianSum& profile, float width) {
    double widest_mm2 = 0;
    for (const GaussianTerm& term : profile.terms) widest_mm2 = std::max(widest_mm2, term.variance_mm2);
    const float reach = kReachSigma * width * float(std::sqrt(widest_mm2));
    return reach > 0 ? reach : 1;
}

double share_within(const GaussianSum& profile, float width, int channel, double distance_mm) {
    double sum = 0, total = 0;
    for (const GaussianTerm& term : profile.terms) {
        const double weight = term.weight[size_t(channel)];
        const double sigma_mm = width * std::sqrt(term.variance_mm2);
        total += weight;
        sum += weight * (sigma_mm > 0 ? std::erf(distance_mm / (std::sqrt(2.0) * sigma_mm)) : 1.0);
    }
    return total > 0 ? sum / total : 1;
}

}  // namespace dermis::screen_space_separable
