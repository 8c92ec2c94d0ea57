#include "techniques/texture_space_gaussians/shared_gaussians.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"

using namespace dermis;
using namespace dermis::texture_space_gaussians;

namespace {

// Largest difference of a colour's damping from the profile's, for waves from 100 mm to two texels.
double largest_error(const GaussianSum& profile, const GaussianSum& shared, double texel_mm) {
    double largest = 0;
    for (double wave_mm = 100; wave_mm > 2 * texel_mm; wave_mm *= 0.95) {
        const double x = 2 * std::numbers::pi * std::numbers::pi / (wave_mm * wave_mm);
        const Vec3 d = profile_transfer(shared, x) - profile_transfer(profile, x);
        for (const float value : {d.x, d.y, d.z}) largest = std::max(largest, double(std::abs(value)));
    }
    return largest;
}

}  // namespace

TEST(SharedGaussians, few_damp_waves_as_every_skin_profile_does) {
    for (const char* name : {"gpu_gems_3", "jensen_skin1", "openpbr_skin_1", "openpbr_skin_3"})
        for (const double texel_mm : {0.05, 0.2, 0.8, 1.6}) {
            const GaussianSum skin = to_gaussian_sum(*find_profile(name)).sum;
            const GaussianSum shared = shared_gaussians(skin, texel_mm);
            EXPECT_LE(shared.terms.size(), size_t(kMostSharedGaussians) + 1) << name;
            EXPECT_LT(largest_error(skin, shared, texel_mm), 0.037) << name << ' ' << texel_mm;
        }
}

TEST(SharedGaussians, as_many_as_the_texels_can_tell_apart) {
    const auto blurred = [](double texel_mm) {
        const GaussianSum shared = shared_gaussians(gpu_gems_3_skin(), texel_mm);
        return std::ranges::count_if(shared.terms, [](const GaussianTerm& t) { return t.variance_mm2 > 0; });
    };
    EXPECT_EQ(blurred(1.6), 2);
    EXPECT_EQ(blurred(0.8), 2);
    EXPECT_EQ(blurred(0.2), 4);
}

TEST(SharedGaussians, one_that_the_texels_hold_comes_back) {
    const GaussianSum own{.name = "own", .terms = {{.variance_mm2 = 2, .weight = {0.5, 0.3, 0}}}};
    const GaussianSum shared = shared_gaussians(own, 0.1);
    ASSERT_EQ(shared.terms.size(), 2u);
    EXPECT_EQ(shared.terms[0].variance_mm2, 0);
    EXPECT_NEAR(shared.terms[1].variance_mm2, 2, 0.05);
    // A colour that the skin does not reflect is left as it is.
    for (const size_t c : {size_t(0), size_t(1)}) EXPECT_NEAR(shared.terms[1].weight[c], 1, 0.01) << c;
    EXPECT_NEAR(shared.terms[1].weight[2], 0, 1e-6);
}

TEST(SharedGaussians, shares_are_parts_of_one) {
    for (const double texel_mm : {0.01, 0.3, 1.0, 100.0}) {
        const GaussianSum shared = shared_gaussians(gpu_gems_3_skin(), texel_mm);
        for (size_t c = 0; c < 3; ++c) {
            double sum = 0;
            for (const GaussianTerm& term : shared.terms) {
                EXPECT_GE(term.weight[c], 0) << texel_mm;
                sum += term.weight[c];
            }
            EXPECT_NEAR(sum, 1, 1e-5) << texel_mm;
        }
    }
}

TEST(SharedGaussians, of_a_profile_without_width_there_are_none) {
    EXPECT_TRUE(shared_gaussians({}, 1).terms.empty());
    EXPECT_TRUE(shared_gaussians({.name = "point", .terms = {{.variance_mm2 = 0, .weight = {1, 1, 1}}}}, 1)
                    .terms.empty());
}
