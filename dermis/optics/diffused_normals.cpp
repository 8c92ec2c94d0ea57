#include "dermis/optics/diffused_normals.h"

#include <algorithm>
#include <array>

namespace dermis::inline optics {
namespace {

// Per channel, weight and weight times variance: of all Gaussians, and of those that are stored.
struct Spreads {
    Rgb total = {}, spread_mm2 = {}, wide = {}, wide_spread_mm2 = {};
};

Spreads spreads_of(const GaussianSum& profile, const DiffusedNormalsRequest& request) {
    Spreads sum;
    for (const GaussianTerm& term : profile.terms)
        for (size_t c = 0; c < 3; ++c) {
            sum.total[c] += term.weight[c];
            sum.spread_mm2[c] += term.weight[c] * term.variance_mm2;
            if (term.variance_mm2 < double(request.finest_variance_mm2)) continue;
            sum.wide[c] += term.weight[c];
            sum.wide_spread_mm2[c] += term.weight[c] * term.variance_mm2;
        }
    return sum;
}

}  // namespace

Vec3 own_normal_weights(const GaussianSum& profile, const DiffusedNormalsRequest& request) {
    const Spreads sum = spreads_of(profile, request);
    std::array<float, 3> own = {1, 1, 1};
    for (size_t c = 0; c < 3; ++c) {
        const size_t stored = std::min(c, size_t(1));
        if (sum.wide_spread_mm2[stored] <= 0 || sum.total[c] <= 0) continue;
        const double per_weight_mm2 = sum.wide_spread_mm2[stored] / sum.wide[stored];
        own[c] = float(1 - std::min(sum.spread_mm2[c] / sum.total[c] / per_weight_mm2, 1.0));
    }
    return {own[0], own[1], own[2]};
}

float green_spread(const GaussianSum& profile, const DiffusedNormalsRequest& request) {
    const Spreads sum = spreads_of(profile, request);
    if (sum.wide_spread_mm2[0] <= 0 || sum.wide[1] <= 0) return 0;
    return float(sum.wide_spread_mm2[1] / sum.wide[1] / (sum.wide_spread_mm2[0] / sum.wide[0]));
}

}  // namespace dermis::inline optics
