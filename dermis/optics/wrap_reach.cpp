#include "dermis/optics/wrap_reach.h"

#include <algorithm>
#include <cmath>

namespace dermis::inline optics {

WrapReach wrap_reach(const GaussianSum& profile) {
    constexpr double kSharpest = 0.25;  // (1/2 per mm)^2
    WrapReach reach;
    for (size_t c = 0; c < 3; ++c) {
        double total = 0, second_moment = 0, damped = 0;
        for (const GaussianTerm& term : profile.terms) {
            total += term.weight[c];
            second_moment += term.weight[c] * term.variance_mm2;
            damped += term.weight[c] * std::exp(-term.variance_mm2 * kSharpest);
        }
        if (!(second_moment > 0)) continue;
        second_moment /= total;
        const double lost = 1 - damped / total;
        reach.second_moment_mm2[c] = second_moment;
        reach.bend_mm2[c] = std::max(second_moment / lost - 1 / kSharpest, 0.0);
    }
    return reach;
}

}  // namespace dermis::inline optics
