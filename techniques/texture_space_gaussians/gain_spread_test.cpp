#include "techniques/texture_space_gaussians/gain_spread.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"

using namespace dermis;
using namespace dermis::texture_space_gaussians;

namespace {

// Variance along one axis of the profile times r^power, by integration over the distance r.
double variance_by_integration_mm2(const GaussianSum& profile, size_t c, int power) {
    double above = 0, below = 0;
    constexpr double kRatio = 1.001;
    for (double r = 1e-4; r < 200; r *= kRatio) {
        double radial = 0;
        for (const GaussianTerm& term : profile.terms)
            radial += term.weight[c] / term.variance_mm2 * std::exp(-r * r / (2 * term.variance_mm2));
        const double ring = std::pow(r, power) * radial * r * r;  // one r of the ring, one of the step
        above += ring * r * r / 2;
        below += ring;
    }
    return above / below;
}

GaussianSum openpbr_3() {
    return to_gaussian_sum(*find_profile("openpbr_skin_3")).sum;
}

}  // namespace

TEST(GainSpread, variance_is_that_of_the_profile_times_the_squared_distance) {
    const GaussianSum skin = openpbr_3();
    const Vec3 variance = gain_variance_mm2(skin);
    const float of_channel[] = {variance.x, variance.y, variance.z};
    for (size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(of_channel[c] / variance_by_integration_mm2(skin, c, 2), 1, 1e-3) << c;
    // Burley's own is 7.5; the fitted Gaussians lack the end of its tail.
    EXPECT_NEAR(double(variance.x) / variance_by_integration_mm2(skin, 0, 0), 6.1, 0.1);
}

TEST(GainSpread, the_mixture_has_this_variance_where_the_widest_gaussian_is_wide_enough) {
    const GaussianSum skin = openpbr_3();
    constexpr double kWidestMm2 = 35;
    const Vec3 share = widest_share_of_gain(skin, kWidestMm2), wanted = gain_variance_mm2(skin);
    EXPECT_EQ(share.x, 1) << "red wants more than the widest Gaussian";
    EXPECT_GT(wanted.x, kWidestMm2);
    for (const auto& [c, s, v] : {std::tuple{1, share.y, wanted.y}, {2, share.z, wanted.z}})
        EXPECT_NEAR(s * kWidestMm2 + (1 - s) * variance_by_integration_mm2(skin, size_t(c), 0), v,
                    0.01 * double(v))
            << c;
}

TEST(GainSpread, without_width_there_is_none) {
    EXPECT_EQ(widest_share_of_gain({}, 1), Vec3());
    EXPECT_EQ(widest_share_of_gain(openpbr_3(), 0), Vec3());
}
