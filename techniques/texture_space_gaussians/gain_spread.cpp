#include "techniques/texture_space_gaussians/gain_spread.h"

#include <algorithm>

namespace dermis::texture_space_gaussians {
namespace {

// The sum of w v^power over the sum of w v^(power - 1).
double moment_ratio(const GaussianSum& profile, size_t c, int power) {
    double above = 0, below = 0;
    for (const GaussianTerm& term : profile.terms) {
        const double v = term.variance_mm2, weight = term.weight[c] * (power == 2 ? v : 1);
        above += weight * v;
        below += weight;
    }
    return below > 0 ? above / below : 0;
}

}  // namespace

Vec3 gain_variance_mm2(const GaussianSum& profile) {
    const auto variance = [&](size_t c) { return float(2 * moment_ratio(profile, c, 2)); };
    return {variance(0), variance(1), variance(2)};
}

Vec3 widest_share_of_gain(const GaussianSum& profile, double widest_variance_mm2) {
    const Vec3 wanted = gain_variance_mm2(profile);
    const auto share = [&](size_t c, float wanted_mm2) {
        const double of_profile = moment_ratio(profile, c, 1);
        if (!(widest_variance_mm2 > of_profile)) return 0.0f;
        return float(
            std::clamp((double(wanted_mm2) - of_profile) / (widest_variance_mm2 - of_profile), 0.0, 1.0));
    };
    return {share(0, wanted.x), share(1, wanted.y), share(2, wanted.z)};
}

}  // namespace dermis::texture_space_gaussians
