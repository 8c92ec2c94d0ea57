#include "dermis/optics/gaussian_channels.h"

#include <algorithm>

namespace dermis::inline optics {

std::vector<ChannelGaussians> by_channel(const GaussianSum& sum) {
    std::vector<GaussianTerm> terms = sum.terms;
    std::ranges::stable_sort(terms, {}, &GaussianTerm::variance_mm2);
    std::vector<ChannelGaussians> all;
    std::array<size_t, 3> count = {0, 0, 0};
    for (const GaussianTerm& term : terms)
        for (size_t c = 0; c < 3; ++c) {
            if (term.weight[c] == 0) continue;
            if (count[c] == all.size()) all.emplace_back();
            all[count[c]].weight[c] = term.weight[c];
            all[count[c]++].variance_mm2[c] = term.variance_mm2;
        }
    return all;
}

}  // namespace dermis::inline optics
