#include "dermis/rays/curvature_gain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/optics/conversions.h"
#include "dermis/optics/presets.h"

namespace dermis {
namespace {

// Lengths in reduced mean free paths: sigma_t' is 1 in every channel.
ScatteringMedium medium_of_reduced(const Rgb& albedo, double g, double eta) {
    ScatteringMedium medium = medium_of(albedo, {1, 1, 1}, 0, eta);
    for (double& sigma_s : medium.sigma_s_per_mm) sigma_s /= 1 - g;
    medium.g = g;
    return medium;
}

// The first order: half of the difference of a ball and a cavity of 16 mean free paths.
constexpr double kFaint = 1.0 / 16;
Rgb walked_slope_mm(const WalkedGains& gains) {
    Rgb slope = {0, 0, 0};
    for (size_t c = 0; c < 3; ++c)
        slope[c] = (gains.samples[1].gain[c] - gains.samples[0].gain[c]) / (2 * kFaint);
    return slope;
}
WalkedGains walk_faint(const ScatteringMedium& medium) {
    return walk_gain(medium, std::array{-kFaint, kFaint}, 1 << 17, 5);
}

TEST(CurvatureGain, BallsReturnMoreThanFlatSkinAndCavitiesLess) {
    const WalkedGains gains =
        walk_gain(medium_of_reduced({0.6, 0.35, 0.1}, 0, 1), std::array{-0.25, 1e-5, 0.25}, 1 << 13, 1);
    for (size_t c = 0; c < 3; ++c) {
        EXPECT_LT(gains.samples[0].gain[c], 0.85);
        EXPECT_NEAR(gains.samples[1].gain[c], 1, 4 * gains.standard_errors[1][c]) << "nearly flat";
        EXPECT_GT(gains.samples[2].gain[c], 1.2);
    }
}

TEST(CurvatureGain, ABallMuchSmallerThanAPathReturnsEverything) {
    const WalkedGains gains =
        walk_gain(medium_of_reduced({0.6, 0.35, 0.1}, 0, 1), std::array{200.0}, 1 << 12, 1);
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(gains.samples[0].gain[c] * gains.flat[c], 1, 0.01);
}

TEST(CurvatureGain, DiffusionPredictsTheFirstOrderOfBrightSkin) {
    for (const double eta : {1.0, 1.4}) {
        const ScatteringMedium medium = medium_of_reduced({0.75, 0.6, 0.35}, 0, eta);
        const WalkedGains gains = walk_faint(medium);
        const Rgb walked = walked_slope_mm(gains);
        for (int c = 0; c < 2; ++c) {
            const double derived = diffusion_gain_slope_mm(medium, c, gains.flat[size_t(c)]);
            RecordProperty("slope", std::to_string(walked[size_t(c)]));
            EXPECT_NEAR(derived / walked[size_t(c)], 1, 0.17) << "eta " << eta << ", channel " << c;
        }
        EXPECT_GT(diffusion_gain_slope_mm(medium, 2, gains.flat[2]) / walked[2], 1.1) << "not diffusive";
    }
}

TEST(CurvatureGain, ForwardScatteringOfTheSameReducedMediumHasASlopeWithinSixthOfIt) {
    const Rgb isotropic = walked_slope_mm(walk_faint(medium_of_reduced({0.6, 0.5, 0.4}, 0, 1)));
    const Rgb forward = walked_slope_mm(walk_faint(medium_of_reduced({0.6, 0.5, 0.4}, 0.8, 1)));
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(forward[c] / isotropic[c], 1, 0.17);
}

TEST(CurvatureGain, TheFormIsNearWalksInBallsFromTwoMillimetresUp) {
    for (const char* name : {"openpbr_skin_3", "jensen_skin1"}) {
        const ScatteringMedium medium = walk_medium_of(*find_profile(name));
        const GainForm form = walked_gain_form(medium);
        const WalkedGains gains = walk_gain(medium, std::array{0.05, 0.1, 0.3, 0.5}, 1 << 15, 99);
        for (size_t i = 0; i < gains.samples.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                const double walked = gains.samples[i].gain[size_t(c)];
                const double closed = gain(form, c, gains.samples[i].curvature_per_mm);
                EXPECT_NEAR(closed / std::max(1.0, walked), walked / std::max(1.0, walked), 0.06)
                    << name << " at " << gains.samples[i].curvature_per_mm << ", channel " << c;
            }
    }
}

}  // namespace
}  // namespace dermis
