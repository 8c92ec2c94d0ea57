// Weights of the smoother normal: the limits, and the order of the channels.

#include "techniques/preintegrated/normal_blend.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/optics/presets.h"

using namespace dermis;

namespace {

GaussianSum one_gaussian(double variance_mm2) {
    return {.terms = {{.variance_mm2 = variance_mm2, .weight = {1, 1, 1}}}};
}

}  // namespace

TEST(NormalBlend, is_sharp_where_light_hardly_scatters) {
    const NormalBlend blend = normal_blend(one_gaussian(1e-6), 0.2, 3);
    EXPECT_EQ(blend.lod_bias, 0) << "a texel is wider than the scattering";
    EXPECT_EQ(blend.weight, (Rgb{0, 0, 0}));
}

TEST(NormalBlend, is_all_smooth_where_the_smoother_read_is_the_scattering) {
    // The box of sharp * 2^3 has the kernel's own variance.
    const double sharp_mm = 0.2, smooth_variance_mm2 = std::pow(8 * sharp_mm, 2) / 12;
    const NormalBlend blend =
        normal_blend(one_gaussian(smooth_variance_mm2 - sharp_mm * sharp_mm / 12), sharp_mm, 3);
    EXPECT_NEAR(blend.weight[0], 1, 1e-2);
}

TEST(NormalBlend, follows_the_widths_of_the_channels) {
    for (const double sharp_mm : {0.1, 0.3, 1.0}) {
        const NormalBlend skin = normal_blend(gpu_gems_3_skin(), sharp_mm, 3);
        EXPECT_GT(skin.weight[0], skin.weight[1]) << sharp_mm;
        EXPECT_GT(skin.weight[1], skin.weight[2]) << sharp_mm;
        for (const double weight : skin.weight) {
            EXPECT_GE(weight, 0);
            EXPECT_LE(weight, 1);
        }
    }
}

TEST(NormalBlend, keeps_relief_in_green_that_red_loses) {
    const NormalBlend skin = normal_blend(gpu_gems_3_skin(), 0.2, 3);
    EXPECT_GT(skin.weight[0], 0.9);
    EXPECT_GT(skin.weight[1], 0.1);
    EXPECT_LT(skin.weight[1], 0.5);
}

TEST(NormalBlend, never_reads_wider_than_half_of_what_red_scatters) {
    const double variance_mm2 = 1.5;
    for (const double sharp_mm : {0.01, 0.2, 1.0, 3.0, 10.0}) {
        const NormalBlend blend = normal_blend(one_gaussian(variance_mm2), sharp_mm, 3);
        EXPECT_GE(blend.lod_bias, 0);
        EXPECT_LE(blend.lod_bias, 3);
        if (blend.lod_bias > 0) {
            EXPECT_LE(sharp_mm * std::exp2(blend.lod_bias), 0.5 * std::sqrt(12 * variance_mm2) * 1.0001);
        }
    }
}

TEST(NormalBlend, is_the_best_weight_from_0_to_1_for_ridges) {
    // The squared distance between what scatters and what the blend makes, on a fine grid of wave numbers k;
    // the power of relief falls as 1 / k^2.
    const GaussianSum profile = gpu_gems_3_skin();
    const double sharp_mm = 0.2;
    const NormalBlend blend = normal_blend(profile, sharp_mm, 3);
    const double s0 = sharp_mm * sharp_mm / 12, s1 = s0 * std::exp2(2 * blend.lod_bias);
    const auto squared_distance = [&](size_t channel, double x) {
        double sum = 0, total = 0;
        for (const GaussianTerm& term : profile.terms) total += term.weight[channel];
        for (double k = 0.005; k < 120; k += 0.01) {
            double target = 0;
            for (const GaussianTerm& term : profile.terms)
                target += term.weight[channel] / total * std::exp(-(term.variance_mm2 + s0) * k * k / 2);
            const double made = (1 - x) * std::exp(-s0 * k * k / 2) + x * std::exp(-s1 * k * k / 2);
            sum += (target - made) * (target - made) / (k * k);
        }
        return sum;
    };
    for (size_t c = 0; c < 3; ++c)
        for (const double step : {-0.02, 0.02})
            if (blend.weight[c] + step <= 1)
                EXPECT_LT(squared_distance(c, blend.weight[c]), squared_distance(c, blend.weight[c] + step))
                    << c;
}
