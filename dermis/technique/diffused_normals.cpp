#include "dermis/technique/diffused_normals.h"

#include <algorithm>
#include <array>

namespace dermis {

Vec3 own_normal_weights(const GaussianSum& profile, const DiffusedNormalsRequest& request) {
    std::array<double, 3> total = {}, wide = {}, spread_mm2 = {};
    for (const GaussianTerm& term : profile.terms)
        for (size_t c = 0; c < 3; ++c) {
            total[c] += term.weight[c];
            if (term.variance_mm2 < double(request.finest_variance_mm2)) continue;
            wide[c] += term.weight[c];
            spread_mm2[c] += term.weight[c] * term.variance_mm2;
        }
    for (size_t c = 0; c < 3; ++c)
        if (total[c] > 0) wide[c] /= total[c], spread_mm2[c] /= total[c];
    if (spread_mm2[1] > 0) wide[2] = std::min(wide[1] * spread_mm2[2] / spread_mm2[1], 1.0);
    return {float(1 - wide[0]), float(1 - wide[1]), float(1 - wide[2])};
}

}  // namespace dermis
