#include "dermis/optics/blur_waves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dermis::inline optics {

WaveCurve blur_waves(const GaussianSum& profile, double texel_mm) {
    const auto [narrowest, widest] = std::ranges::minmax(profile.terms, {}, &GaussianTerm::variance_mm2);
    const double first = 0.1 / widest.variance_mm2;
    const double shortest_wave = 2 * std::pow(std::numbers::pi / (2 * texel_mm), 2);
    const double last = std::max(std::min(4 / narrowest.variance_mm2, shortest_wave), 10 * first);
    WaveCurve x;
    for (size_t i = 0; i < kBlurWaves; ++i)
        x[i] = first * std::pow(last / first, double(i) / (kBlurWaves - 1));
    return x;
}

}  // namespace dermis::inline optics
