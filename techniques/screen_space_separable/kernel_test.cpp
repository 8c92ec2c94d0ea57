#include "techniques/screen_space_separable/kernel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/optics/artistic_kernel.h"

using namespace dermis;
using namespace dermis::screen_space_separable;

// The line spread function is the profile integrated along a line: checked by summing the profile itself.
TEST(SeparableKernel, is_the_profile_integrated_over_one_direction) {
    const GaussianSum sum = gpu_gems_3_skin();
    const Profile profile = {.name = "gpu_gems_3", .model = sum};
    constexpr double kStep = 0.02, kReach = 10;
    for (const int channel : {kRed, kGreen, kBlue})
        for (const double distance_mm : {1.0, 3.0}) {
            double within = 0, all = 0;
            for (double x = -kReach + kStep / 2; x < kReach; x += kStep)
                for (double y = -kReach + kStep / 2; y < kReach; y += kStep) {
                    const double light = reflectance_per_mm2(profile, channel, std::hypot(x, y));
                    all += light;
                    if (std::abs(x) < distance_mm) within += light;
                }
            EXPECT_NEAR(share_within(sum, 1, channel, distance_mm), within / all, 2e-3) << channel;
        }
}

TEST(SeparableKernel, scales_with_its_width_and_ends_at_its_reach) {
    const GaussianSum sum = gpu_gems_3_skin();
    EXPECT_NEAR(share_within(sum, 2, kRed, 2), share_within(sum, 1, kRed, 1), 1e-12);
    EXPECT_FLOAT_EQ(reach_mm(sum, 2), 2 * reach_mm(sum, 1));
    EXPECT_GT(share_within(sum, 1, kRed, reach_mm(sum, 1)), 0.997);
    EXPECT_EQ(reach_mm({}, 1), 1);
    EXPECT_EQ(share_within(sum, 0, kRed, 0.1), 1);
}

TEST(SeparableKernel, of_two_gaussians_has_their_shares) {
    const TwoGaussians two = {.near_mm = 0.1f, .far_mm = 2, .far_share = {0.6f, 0.3f, 0}};
    const GaussianSum sum = to_gaussian_sum(two);
    // Between the two widths nearly all of the narrow one and little of the wide one has left.
    EXPECT_NEAR(share_within(sum, 1, kRed, 0.4), 0.4 + 0.6 * std::erf(0.4 / (2 * std::sqrt(2.0))), 1e-3);
    EXPECT_NEAR(share_within(sum, 1, kBlue, 0.4), 1, 1e-3);
}

// Strength .48, falloff 1 in red: the light that stays, and of the rest what the widest leaves beyond 5 mm.
TEST(SeparableKernel, of_an_artist_keeps_what_strength_leaves_and_is_narrower_with_less_falloff) {
    const GaussianSum sum = line_kernel(ArtisticKernel());
    for (size_t c = 0; c < 3; ++c) {
        double total = 0;
        for (const GaussianTerm& term : sum.terms) total += term.weight[c];
        EXPECT_NEAR(total, 1, 1e-6) << c;
    }
    EXPECT_NEAR(share_within(sum, 1, kRed, 1e-6), 0.52, 1e-4);
    EXPECT_NEAR(share_within(sum, 1, kBlue, 1e-6), 0.72, 1e-4);
    // .1 / .22 + .118 / .432 + .113 / .753 + .358 / 1.411 + .078 / 2.722 is 1.160.
    EXPECT_NEAR(1 - share_within(sum, 1, kRed, 3.3),
                0.48 *
                    (0.2537 * std::erfc(3.3 / (1.411 * std::sqrt(2.0))) +
                     0.02866 * std::erfc(3.3 / (2.722 * std::sqrt(2.0)))) /
                    1.1602,
                1e-4);
    EXPECT_GT(share_within(sum, 1, kBlue, 0.5), share_within(sum, 1, kRed, 0.5));
}
