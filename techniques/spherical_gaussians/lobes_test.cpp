#include "techniques/spherical_gaussians/lobes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"

using namespace dermis;
using namespace dermis::spherical_gaussians;

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

TEST(SphericalGaussianLobes, keep_weight_and_width_of_the_profile_at_any_count) {
    for (const char* name : {"gpu_gems_3", "jensen_skin1", "burley:0.8,0.4,0.2"}) {
        const GaussianSum sum = to_gaussian_sum(*find_profile(name)).sum;
        const std::vector<ChannelGaussians> all = by_channel(sum);
        for (int count = 1; count <= 6; ++count)
            for (size_t c = 0; c < 3; ++c) {
                const auto by_deviation = lobes_of(sum, count, Width::deviation);
                const auto by_variance = lobes_of(sum, count, Width::variance);
                EXPECT_LE(by_deviation.size(), size_t(count));
                double total = 0;
                for (const ChannelGaussians& lobe : by_deviation) total += lobe.weight[c];
                EXPECT_NEAR(total, 1, 1e-9) << name << count << c;
                EXPECT_NEAR(mean_deviation_mm(by_deviation, c), mean_deviation_mm(all, c), 1e-9) << name;
                EXPECT_NEAR(second_moment_mm2(by_variance, c), second_moment_mm2(all, c), 1e-9) << name;
            }
    }
}

TEST(SphericalGaussianLobes, as_many_as_the_profile_has_are_the_profile) {
    const auto lobes = lobes_of(gpu_gems_3_skin(), 6, Width::deviation);
    const auto all = by_channel(gpu_gems_3_skin());
    ASSERT_EQ(lobes.size(), all.size());
    for (size_t i = 0; i < all.size(); ++i) {
        EXPECT_DOUBLE_EQ(lobes[i].weight[0], all[i].weight[0]) << i;
        EXPECT_DOUBLE_EQ(lobes[i].variance_mm2[0], all[i].variance_mm2[0]) << i;
    }
}

TEST(SphericalGaussianLobes, without_reflectance_are_a_narrow_one) {
    const GaussianSum red = {.name = "red", .terms = {{.variance_mm2 = 1, .weight = {1, 0, 0}}}};
    const auto lobes = lobes_of(red, 2, Width::deviation);
    ASSERT_EQ(lobes.size(), 1u);
    EXPECT_EQ(lobes[0].weight[2], 1);
    EXPECT_LT(lobes[0].variance_mm2[2], 1e-3);
}
