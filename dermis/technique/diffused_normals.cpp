#include "dermis/technique/diffused_normals.h"

#include <algorithm>
#include <array>

namespace dermis {

Vec3 own_normal_weights(const GaussianSum& profile, const DiffusedNormalsRequest& request) {
    std::array<double, 3> total = {}, spread_mm2 = {};
    std::array<double, 3> wide = {}, wide_spread_mm2 = {};
    for (const GaussianTerm& term : profile.terms)
        for (size_t c = 0; c < 3; ++c) {
            total[c] += term.weight[c];
            spread_mm2[c] += term.weight[c] * term.variance_mm2;
            if (term.variance_mm2 < double(request.finest_variance_mm2)) continue;
            wide[c] += term.weight[c];
            wide_spread_mm2[c] += term.weight[c] * term.variance_mm2;
        }
    std::array<float, 3> own = {1, 1, 1};
    for (size_t c = 0; c < 3; ++c) {
        const size_t stored = std::min(c, size_t(1));
        if (wide_spread_mm2[stored] <= 0 || total[c] <= 0) continue;
        const double per_weight_mm2 = wide_spread_mm2[stored] / wide[stored];
        own[c] = float(1 - std::min(spread_mm2[c] / total[c] / per_weight_mm2, 1.0));
    }
    return {own[0], own[1], own[2]};
}

}  // namespace dermis
