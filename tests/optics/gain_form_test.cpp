#include "dermis/optics/gain_form.h"

#include <gtest/gtest.h>

#include "dermis/optics/conversions.h"

namespace dermis {
namespace {

const Rgb kAlbedo = {0.6, 0.35, 0.1};

GainForm example() {
    GainForm form{.slope_mm = {1.2, 0.9, 0.7}, .length_mm = {3, 2, 1.5}};
    for (size_t c = 0; c < 3; ++c)
        form.bend_mm[c] = form.length_mm[c] - form.slope_mm[c] * kAlbedo[c] / (1 - kAlbedo[c]);
    return form;
}

TEST(GainForm, FlatSkinHasAGainOfOneAndTheSlopeIsTheFirstOrder) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(gain(example(), c, 0), 1);
        const double slope = (gain(example(), c, 1e-4) - gain(example(), c, -1e-4)) / 2e-4;
        EXPECT_NEAR(slope, example().slope_mm[size_t(c)], 1e-3);
    }
}

TEST(GainForm, RisesWithCurvatureFromZeroToOneOverTheAlbedo) {
    for (int c = 0; c < 3; ++c) {
        double before = 0;
        for (double k = -4; k < 1e4; k = k < 4 ? k + 0.05 : 2 * k) {
            const double now = gain(example(), c, k);
            EXPECT_GE(now, before) << k;
            before = now;
        }
        EXPECT_NEAR(before, 1 / kAlbedo[size_t(c)], 0.01);
    }
}

TEST(GainForm, FoldsLoseLessThanCavities) {
    for (int c = 0; c < 3; ++c) {
        const auto i = size_t(c);
        const GainForm form = example();
        for (const double k : {-0.05, -0.2, -1.0}) {
            const double cavity = 1 + form.slope_mm[i] * k / (1 - form.bend_mm[i] * k);
            EXPECT_GT(gain(form, c, k), cavity + 0.001) << k;
        }
        EXPECT_GT(gain(form, c, -10), 1 - 1.01 * form.slope_mm[i] / (kGainFold * form.length_mm[i]));
    }
}

TEST(GainForm, TheFitFindsTheFormThatMadeTheSamples) {
    std::vector<GainSample> samples;
    for (const double k : {0.02, 0.05, 0.1, 0.25, 0.5}) {
        samples.push_back({.curvature_per_mm = k});
        for (int c = 0; c < 3; ++c) samples.back().gain[size_t(c)] = gain(example(), c, k);
    }
    const GainForm fitted = fit_gain_form(samples, kAlbedo);
    for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(fitted.slope_mm[c], example().slope_mm[c], 0.01);
        EXPECT_NEAR(fitted.length_mm[c], example().length_mm[c], 0.05);
    }
}

TEST(GainForm, WithoutAbsorptionOrWithoutScatteringCurvatureChangesNothing) {
    const std::vector<GainSample> samples = {{.curvature_per_mm = 0.2, .gain = {1.3, 1.3, 1.3}}};
    const GainForm form = fit_gain_form(samples, {0, 1, 0.5});
    EXPECT_EQ(gain(form, 0, 0.3), 1);
    EXPECT_EQ(gain(form, 1, 0.3), 1);
    EXPECT_GT(gain(form, 2, 0.3), 1.2);
}

}  // namespace
}  // namespace dermis
