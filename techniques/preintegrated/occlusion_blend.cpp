#include "techniques/preintegrated/occlusion_blend.h"

#include <algorithm>

#include "shaders/include/constants.h"

namespace dermis {

std::array<Rgb, 3> occlusion_blend(const GaussianSum& profile) {
    const std::array<double, 4> kVariances_mm2 = {0, kOcclusionVariance0Mm2, kOcclusionVariance1Mm2,
                                                  kOcclusionVariance2Mm2};
    std::array<Rgb, 4> shares = {};
    Rgb total = {};
    for (const GaussianTerm& term : profile.terms) {
        const double v = std::min(term.variance_mm2, kVariances_mm2.back());
        size_t i = 0;
        while (v > kVariances_mm2[i + 1]) ++i;
        const double upper = (v - kVariances_mm2[i]) / (kVariances_mm2[i + 1] - kVariances_mm2[i]);
        for (size_t c = 0; c < 3; ++c) {
            shares[i][c] += term.weight[c] * (1 - upper);
            shares[i + 1][c] += term.weight[c] * upper;
            total[c] += term.weight[c];
        }
    }
    std::array<Rgb, 3> weights = {};
    for (size_t i = 0; i < 3; ++i)
        for (size_t c = 0; c < 3; ++c) weights[i][c] = total[c] > 0 ? shares[i + 1][c] / total[c] : 0;
    return weights;
}

}  // namespace dermis
