// shadow=gathered: its taps, and a shadow's edge on flat skin against the exact answer.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dermis/bake/shadow_ramp.h"
#include "dermis/optics/shadow_edge.h"
#include "render/grid_scene.h"
#include "support/built_in.h"
#include "techniques/preintegrated/constants.h"
#include "techniques/preintegrated/weights.h"

using namespace dermis;
using namespace dermis::preintegrated;

namespace {

class GatheredShadow : public PreintegratedTest {};

// The same by a sum over the disk's points.
double summed_over_disk(double variance_mm2, double disk_mm, double distance_mm) {
    constexpr int kPoints = 40000;
    double sum = 0;
    for (int i = 0; i < kPoints; ++i) {
        const double t = disk_mm * std::sqrt((i + 0.5) / kPoints), angle = i * 2.39996323;
        const double x = distance_mm - t * std::cos(angle), y = t * std::sin(angle);
        sum += std::exp(-0.5 * (x * x + y * y) / variance_mm2);
    }
    return sum / kPoints / (2 * std::numbers::pi * variance_mm2);
}

// Of light at 45 degrees that an edge at x = 0 blocks on one side.
double scattered_edge(double x_mm, size_t channel) {
    double light = 0, total = 0;
    for (const GaussianTerm& term : gpu_gems_3_skin().terms) {
        const double sigma = std::sqrt(term.variance_mm2);
        for (int i = -300; i <= 300; ++i) {
            const double t = i / 50.0, weight = term.weight[channel] * std::exp(-0.5 * t * t);
            // The disk is round as the light sees it.
            const double place = (x_mm + t * sigma) / (0.5 * kLightEdgeMm * std::numbers::sqrt2);
            light += weight * disk_share(std::clamp(place, -1.0, 1.0));
            total += weight;
        }
    }
    return light / total;
}

}  // namespace

TEST_F(GatheredShadow, a_gaussian_over_a_disk_is_the_sum_over_its_points) {
    for (const double variance_mm2 : {0.03, 0.19, 2.0, 7.4})
        for (const double distance_mm : {0.0, 0.6, 1.0, 2.5}) {
            const double peak = gaussian_over_disk(variance_mm2, 1, 0);
            EXPECT_NEAR(gaussian_over_disk(variance_mm2, 1, distance_mm),
                        summed_over_disk(variance_mm2, 1, distance_mm), 2e-3 * peak)
                << variance_mm2 << " at " << distance_mm;
        }
}

TEST_F(GatheredShadow, each_channel_s_weights_have_the_whole_light) {
    const std::vector<ShadowTap> taps = shadow_taps(gpu_gems_3_skin());
    ASSERT_EQ(taps.size(), size_t(kShadowGatherTaps));
    Rgb sum = {};
    double penumbra = 0, last_mm = 0;
    for (const ShadowTap& tap : taps) {
        for (size_t c = 0; c < 3; ++c) sum[c] += tap.weight[c] / kShadowGatherTaps;
        penumbra += tap.penumbra_weight / kShadowGatherTaps;
        EXPECT_GE(tap.radius_mm, last_mm);
        last_mm = tap.radius_mm;
    }
    EXPECT_NEAR(sum[0], 1, 1e-9) << "red scatters farthest";
    EXPECT_NEAR(sum[1], 1, 0.02);
    EXPECT_NEAR(sum[2], 1, 0.02);
    EXPECT_NEAR(penumbra, 1, 1e-9) << "the shader takes it as known";
}

TEST_F(GatheredShadow, an_edge_on_flat_skin_is_the_exact_one) {
    const Scene scene = make_wall_and_bar(-20, 12);
    const auto row = [&](const char* shadow) {
        const Image picture =
            draw_grid(scene, {{"transmission", "none"}, {"specular", "none"}, {"shadow", shadow}});
        std::vector<Rgb> light(kGrid);
        for (int x = 0; x < kGrid; ++x)
            for (int c = 0; c < 3; ++c)
                light[size_t(x)][size_t(c)] =
                    picture.at(x, kGrid / 2, c) / picture.at(kGrid - 2, kGrid / 2, c);
        return light;
    };
    // The filtered shadow has half of the light at the edge.
    const std::vector<Rgb> plain = row("plain");
    size_t dark = 3 * kGrid / 8;
    while (plain[dark + 1][0] < 0.5) ++dark;
    const double edge = double(dark) + (0.5 - plain[dark][0]) / (plain[dark + 1][0] - plain[dark][0]);
    const auto error = [&](const std::vector<Rgb>& light, size_t channel) {
        double largest = 0;
        for (size_t x = 3 * kGrid / 8; x < kGrid - 2; ++x)
            largest =
                std::max(largest, std::abs(light[x][channel] - scattered_edge(double(x) - edge, channel)));
        return largest;
    };
    const std::vector<Rgb> gathered = row("gathered");
    const std::vector<Rgb> scattered = row("scattered");
    EXPECT_GT(error(plain, 0), 0.11) << "red scatters at this edge";
    for (const auto* light : {&gathered, &scattered})
        for (const size_t channel : {0u, 1u, 2u})
            EXPECT_LT(error(*light, channel), channel == 0 ? 0.07 : 0.035) << channel;
}

// The cheek below the lobe of an ear is lit through a gap, at grazing light. Of its quadric a few places only
// are lit: where they decided, a patch of light with a hard edge stood there, 893 pixels. The lobe's own rim,
// which light reaches through its skin, is a few of these.
TEST_F(GatheredShadow, a_few_lit_places_at_grazing_light_do_not_decide) {
    const Scene scene = load("ear");
    Renderer renderer = make_renderer(scene);
    constexpr int kSide = 250;
    const auto light = [&](const char* shadow) {
        return radiance(renderer, technique(),
                        values_of({{"transmission", "none"}, {"specular", "none"}, {"shadow", shadow}}),
                        {.width = kSide, .height = kSide});
    };
    const Image gathered = light("gathered"), plain = light("plain");
    int brighter = 0;
    for (int y = kSide / 2; y < kSide; ++y)
        for (int x = 30; x < 110; ++x) brighter += gathered.at(x, y, 0) > plain.at(x, y, 0) + 0.05f;
    EXPECT_LT(brighter, 200);
}
