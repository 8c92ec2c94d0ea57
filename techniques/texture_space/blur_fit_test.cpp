#include "techniques/texture_space/blur_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"

using namespace dermis;
using namespace dermis::texture_space;

namespace {

// Largest difference of a colour's damping between the passes and the profile, for waves from 100 mm to
// `shortest_mm`.
double largest_error(const GaussianSum& profile, const BlurFitSettings& settings, double shortest_mm) {
    const std::vector<BlurPass> passes = fit_blur(profile, settings);
    double largest = 0;
    for (double wave_mm = 100; wave_mm > shortest_mm; wave_mm *= 0.9) {
        const double x = 2 * std::numbers::pi * std::numbers::pi / (wave_mm * wave_mm);
        const Vec3 d = blur_transfer(passes, settings, x) - profile_transfer(profile, x);
        for (const float value : {d.x, d.y, d.z}) largest = std::max(largest, double(std::abs(value)));
    }
    return largest;
}

}  // namespace

TEST(BlurFit, four_passes_damp_waves_as_every_skin_profile_does) {
    for (const char* name : {"gpu_gems_3", "jensen_skin1", "openpbr_skin_3"}) {
        const GaussianSum skin = to_gaussian_sum(*find_profile(name)).sum;
        EXPECT_LT(largest_error(skin, {.passes = 4, .texel_mm = 0.05}, 0.5), 0.085) << name;
        EXPECT_GT(largest_error(skin, {.passes = 1, .texel_mm = 0.05}, 0.5), 0.085) << name;
    }
}

TEST(BlurFit, colours_that_scatter_less_take_less_of_the_wide_taps) {
    const std::vector<BlurPass> passes = fit_blur(gpu_gems_3_skin(), {.passes = 4, .texel_mm = 0.1});
    ASSERT_FALSE(passes.empty());
    EXPECT_GT(passes.back().share.x, 4 * passes.back().share.z);
    for (size_t i = 1; i < passes.size(); ++i) EXPECT_GT(passes[i].radius, passes[i - 1].radius);
}

TEST(BlurFit, twice_the_profile_on_texels_of_twice_the_size_is_twice_the_radius) {
    GaussianSum wide = gpu_gems_3_skin();
    for (GaussianTerm& term : wide.terms) term.variance_mm2 *= 4;
    const auto once = fit_blur(gpu_gems_3_skin(), {.texel_mm = 0.2}),
               twice = fit_blur(wide, {.texel_mm = 0.4});
    ASSERT_EQ(once.size(), twice.size());
    for (size_t i = 0; i < once.size(); ++i) {
        EXPECT_NEAR(twice[i].radius, 2 * once[i].radius, 1e-4);
        EXPECT_NEAR(twice[i].share.x, once[i].share.x, 1e-4);
    }
}

// The eight taps of blur_mm.frag, summed one by one.
TEST(BlurFit, the_damping_of_a_pass_is_that_of_its_taps_over_all_directions) {
    const BlurFitSettings settings{.texel_mm = 1e-3};
    const BlurPass pass{.radius = 2, .share = {1, 1, 1}};
    constexpr int kDirections = 360;
    for (const double wave_mm : {30.0, 10.0, 5.0, 3.0}) {
        double sum = 0;
        for (int i = 0; i < kDirections; ++i)
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) {
                    if (dx == 0 && dy == 0) continue;
                    const double angle = 2 * std::numbers::pi * i / kDirections;
                    const double along_mm = 2 * (dx * std::cos(angle) + dy * std::sin(angle));
                    sum += (2 - std::abs(dx)) * (2 - std::abs(dy)) / 12.0 *
                           std::cos(2 * std::numbers::pi * along_mm / wave_mm);
                }
        const double x = 2 * std::numbers::pi * std::numbers::pi / (wave_mm * wave_mm);
        EXPECT_NEAR(blur_transfer({pass}, settings, x).x, sum / kDirections, 1e-4) << wave_mm;
    }
}

TEST(BlurFit, a_profile_without_terms_has_no_pass) {
    EXPECT_TRUE(fit_blur({}, {}).empty());
}
