// The shadow table: its ends, the edge that it describes, and the light of skin outside the penumbra.

#include "dermis/bake/shadow_ramp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dermis/optics/edge_expression.h"
#include "dermis/optics/presets.h"
#include "dermis/optics/shadow_edge.h"

using namespace dermis;

namespace {

const Profile& skin() {
    static const Profile profile{.name = "gpu_gems_3", .source = "", .model = gpu_gems_3_skin()};
    return profile;
}

// An edge in the light of a disk of kLightEdgeMm, blurred by the profile: midpoint sums over where the light
// comes from.
double light_at_mm(double x_mm, size_t channel) {
    double light = 0, total = 0;
    for (const GaussianTerm& term : gpu_gems_3_skin().terms) {
        const double sigma = std::sqrt(term.variance_mm2), step = sigma / 50;
        for (double d = -6 * sigma; d < 6 * sigma; d += step) {
            const double radii = (x_mm + d + 0.5 * step) / (0.5 * kLightEdgeMm);
            const double weight = term.weight[channel] *
                                  std::exp(-0.5 * std::pow((d + 0.5 * step) / sigma, 2)) * step /
                                  (sigma * std::sqrt(2 * std::numbers::pi));
            light += weight * disk_share(radii);
            total += weight;
        }
    }
    return light / total;
}

}  // namespace

TEST(ShadowRamp, the_disk_s_share_has_an_inverse) {
    EXPECT_NEAR(disk_share(0), 0.5, 1e-15);
    EXPECT_NEAR(disk_share(0.5), 0.5 + (0.5 * std::sqrt(0.75) + std::numbers::pi / 6) / std::numbers::pi,
                1e-15);
    for (const double t : {-0.99, -0.3, 0.0, 0.6, 0.95})
        EXPECT_NEAR(disk_offset(disk_share(t)), t, 1e-9) << t;
}

TEST(ShadowRamp, lit_skin_keeps_all_its_light_and_shadow_none) {
    for (const double width_mm : {1.0, 2.0, 3.0, 8.0, 40.0}) {
        const auto ramp = shadow_ramp(skin(), width_mm, 257);
        ASSERT_TRUE(ramp);
        for (size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(ramp->front()[c], 0, 1e-6) << width_mm;
            EXPECT_NEAR(ramp->back()[c], 1, 1e-6) << width_mm;
        }
        for (size_t i = 1; i < ramp->size(); ++i) EXPECT_GE((*ramp)[i][0], (*ramp)[i - 1][0]) << width_mm;
    }
}

TEST(ShadowRamp, narrow_filters_without_scaled_ends_would_darken_lit_skin) {
    EXPECT_NEAR(light_at_mm(1.0, 0), 0.85, 0.01);
    EXPECT_NEAR(light_at_mm(1.5, 0), 0.92, 0.01);
}

TEST(ShadowRamp, is_the_scattered_edge_where_the_filter_reaches_far_enough) {
    constexpr double width_mm = 16;
    const auto ramp = shadow_ramp(skin(), width_mm, 257);
    ASSERT_TRUE(ramp);
    for (size_t i = 8; i < 249; ++i) {
        const double x_mm = 0.5 * width_mm * disk_offset(double(i) / 256);
        for (size_t c = 0; c < 3; ++c)
            EXPECT_NEAR((*ramp)[i][c], light_at_mm(x_mm, c), 3e-3) << x_mm << " mm";
    }
}

TEST(ShadowRamp, its_expression_is_near_it_up_to_3_mm_for_every_preset) {
    const auto error = [](const Profile& profile, double width_mm) {
        return fit_edge_expression(*shadow_ramp(profile, width_mm, 257)).max_error;
    };
    for (const std::string& name : profile_names())
        for (const double width_mm : {1, 2, 3})
            EXPECT_LT(error(*find_profile(name), width_mm), 0.0035) << name;
    EXPECT_LT(error(skin(), 6), 0.006);
    EXPECT_LT(error(skin(), 16), 0.02);
}
