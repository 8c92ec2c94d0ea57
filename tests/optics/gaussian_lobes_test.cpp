#include "dermis/optics/gaussian_lobes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"

using namespace dermis;

namespace {

double mean_deviation_mm(const std::vector<ChannelGaussians>& lobes, size_t channel) {
    double total = 0, sum = 0;
    for (const ChannelGaussians& lobe : lobes) {
        total += lobe.weight[channel];
        sum += lobe.weight[channel] * std::sqrt(lobe.variance_mm2[channel]);
    }
    return sum / total;
}

double second_moment_mm2(const std::vector<ChannelGaussians>& lobes, size_t channel) {
    double total = 0, sum = 0;
    for (const ChannelGaussians& lobe : lobes) {
        total += lobe.weight[channel];
        sum += lobe.weight[channel] * lobe.variance_mm2[channel];
    }
    return sum / total;
}

}  // namespace

TEST(GaussianLobes, keep_weight_and_width_of_the_profile_at_any_count) {
    for (const char* name : {"gpu_gems_3", "jensen_skin1", "burley:0.8,0.4,0.2"}) {
        const GaussianSum sum = to_gaussian_sum(*find_profile(name)).sum;
        const std::vector<ChannelGaussians> all = by_channel(sum);
        for (int count = 1; count <= 6; ++count)
            for (size_t c = 0; c < 3; ++c) {
                const auto by_deviation = lobes_of(sum, count, LobeWidth::deviation);
                const auto by_variance = lobes_of(sum, count, LobeWidth::variance);
                EXPECT_LE(by_deviation.size(), size_t(count));
                double total = 0;
                for (const ChannelGaussians& lobe : by_deviation) total += lobe.weight[c];
                EXPECT_NEAR(total, 1, 1e-9) << name << count << c;
                EXPECT_NEAR(mean_deviation_mm(by_deviation, c), mean_deviation_mm(all, c), 1e-9) << name;
                EXPECT_NEAR(second_moment_mm2(by_variance, c), second_moment_mm2(all, c), 1e-9) << name;
            }
    }
}

TEST(GaussianLobes, as_many_as_the_profile_has_are_the_profile) {
    const auto lobes = lobes_of(gpu_gems_3_skin(), 6, LobeWidth::deviation);
    const auto all = by_channel(gpu_gems_3_skin());
    ASSERT_EQ(lobes.size(), all.size());
    for (size_t i = 0; i < all.size(); ++i) {
        EXPECT_DOUBLE_EQ(lobes[i].weight[0], all[i].weight[0]) << i;
        EXPECT_DOUBLE_EQ(lobes[i].variance_mm2[0], all[i].variance_mm2[0]) << i;
    }
}

TEST(GaussianLobes, the_error_of_merging_falls_with_their_number_to_none) {
    for (const char* name : {"gpu_gems_3", "openpbr_skin_3"}) {
        const GaussianSum sum = to_gaussian_sum(*find_profile(name)).sum;
        const auto error = [&](int count, double radius_mm) {
            return merging_error(sum, lobes_of(sum, count, LobeWidth::deviation), radius_mm);
        };
        EXPECT_GT(error(1, 2), 1.5 * error(2, 2)) << name;
        EXPECT_GT(error(2, 2), 1.1 * error(3, 2)) << name;
        EXPECT_LT(error(6, 2), 1e-9) << name;
        EXPECT_GT(error(2, 2), 2 * error(2, 16)) << name;
    }
}

TEST(GaussianLobes, without_reflectance_are_a_narrow_one) {
    const GaussianSum red = {.name = "red", .terms = {{.variance_mm2 = 1, .weight = {1, 0, 0}}}};
    const auto lobes = lobes_of(red, 2, LobeWidth::deviation);
    ASSERT_EQ(lobes.size(), 1u);
    EXPECT_EQ(lobes[0].weight[2], 1);
    EXPECT_LT(lobes[0].variance_mm2[2], 1e-3);
}
