#include "dermis/rays/ball_exitance.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "dermis/optics/conversions.h"
#include "dermis/optics/presets.h"
#include "dermis/rays/curvature_gain.h"

namespace dermis {
namespace {

constexpr int kBallWalks = 1 << 14;
const std::vector<double> kCurvatures = {1.0 / 64, 0.25};

std::vector<BallExitance> balls() {
    return walk_balls(walk_medium_of(*find_profile("openpbr_skin_3")), kCurvatures, kBallWalks);
}

TEST(BallExitance, LightFromAllAroundIsTheGain) {
    const ScatteringMedium medium = walk_medium_of(*find_profile("openpbr_skin_3"));
    const WalkedGains gains = walk_gain(medium, kCurvatures, kBallWalks, 2);
    for (size_t i = 0; i < kCurvatures.size(); ++i) {
        // The clamped cosine has the mean 1/4 over all directions.
        Rgb mean = {0, 0, 0};
        constexpr int kSteps = 512;
        for (int step = 0; step < kSteps; ++step) {
            const Rgb light = light_on_ball(balls()[i], -1 + (2 * step + 1.0) / kSteps);
            for (size_t c = 0; c < 3; ++c) mean[c] += light[c] / kSteps;
        }
        for (size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(4 * mean[c], gains.samples[i].gain[c], 5 * gains.standard_errors[i][c] + 0.005);
    }
}

// By few walks, whose light itself is off by half a hundredth: it is divided by that of the same walks in
// flat skin.
TEST(BallExitance, OfALargeBallHasLittleOfTheWalksNoise) {
    const ScatteringMedium medium = walk_medium_of(*find_profile("openpbr_skin_3"));
    const std::vector<double> curvatures = {1.0 / 64};
    const WalkedGains gains = walk_gain(medium, curvatures, 1 << 18, 2);
    const BallExitance ball = walk_balls(medium, curvatures, 1 << 14)[0];
    for (size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (const Rgb& share : ball.share) sum += share[c];
        EXPECT_NEAR(sum, gains.samples[0].gain[c], 0.004);
    }
}

TEST(BallExitance, ALargeBallIsNearlyLambertAndASmallOneGlowsBehindTheTerminator) {
    const std::vector<BallExitance> made = balls();
    for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(light_on_ball(made[0], 0.7)[c], 0.7, 0.04);
        EXPECT_LT(light_on_ball(made[0], -0.3)[c], 0.005);
        EXPECT_GT(light_on_ball(made[1], 0)[c], 0.05);
    }
    EXPECT_GT(light_on_ball(made[1], -0.3)[0], light_on_ball(made[1], -0.3)[2]) << "red goes farthest";
}

}  // namespace
}  // namespace dermis
