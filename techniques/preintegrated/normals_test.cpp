// Diffuse normals: the weights of the smoother one, their limits and the order of the channels; normals=lerp,
// the published mix of the normals themselves, beside normals=blended, which mixes their light.

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/optics/presets.h"
#include "render/grid_scene.h"
#include "techniques/preintegrated/weights.h"

using namespace dermis;
using namespace dermis::preintegrated;

namespace {

GaussianSum one_gaussian(double variance_mm2) {
    return {.terms = {{.variance_mm2 = variance_mm2, .weight = {1, 1, 1}}}};
}

class Lerp : public PreintegratedTest {
  protected:
    // Stripes as wide as a pixel, 0.125 mm, that lean towards the light and away from it. Blend and published
    // shader read the same level of them.
    static Image stripes(const char* normals) {
        Scene scene = make_grid_scene();
        for (Vec3& p : scene.objects[0].mesh.positions_mm) p = p * 0.125f;
        scene.camera.eye_mm = scene.camera.eye_mm * 0.125f;
        scene.bounds_radius_mm *= 0.125f;
        scene.lights[0].to_light_world = {0.6f, 0, 0.8f};
        scene.objects[0].mesh.materials[0].normal_map = striped_normal_map();
        return draw_grid(scene, {{"shadow", "plain"}, {"normals", normals}});
    }
};

}  // namespace

TEST(NormalBlend, is_sharp_where_light_hardly_scatters) {
    const NormalBlend blend = normal_blend(one_gaussian(1e-6), 0.2);
    EXPECT_EQ(blend.lod_bias, 0) << "a texel is wider than the scattering";
    EXPECT_EQ(blend.weight, (Rgb{0, 0, 0}));
}

TEST(NormalBlend, is_all_smooth_where_the_smoother_read_is_the_scattering) {
    // The box of sharp * 2^3 has the kernel's own variance.
    const double sharp_mm = 0.2, smooth_variance_mm2 = std::pow(8 * sharp_mm, 2) / 12;
    const NormalBlend blend =
        normal_blend(one_gaussian(smooth_variance_mm2 - sharp_mm * sharp_mm / 12), sharp_mm);
    EXPECT_NEAR(blend.weight[0], 1, 1e-2);
}

TEST(NormalBlend, follows_the_widths_of_the_channels) {
    for (const double sharp_mm : {0.1, 0.3, 1.0}) {
        const NormalBlend skin = normal_blend(gpu_gems_3_skin(), sharp_mm);
        EXPECT_GT(skin.weight[0], skin.weight[1]) << sharp_mm;
        EXPECT_GT(skin.weight[1], skin.weight[2]) << sharp_mm;
        for (const double weight : skin.weight) {
            EXPECT_GE(weight, 0);
            EXPECT_LE(weight, 1);
        }
    }
}

TEST(NormalBlend, keeps_relief_in_green_that_red_loses) {
    const NormalBlend skin = normal_blend(gpu_gems_3_skin(), 0.2);
    EXPECT_GT(skin.weight[0], 0.9);
    EXPECT_GT(skin.weight[1], 0.1);
    EXPECT_LT(skin.weight[1], 0.5);
}

TEST(NormalBlend, never_reads_wider_than_half_of_what_red_scatters) {
    const double variance_mm2 = 1.5;
    for (const double sharp_mm : {0.01, 0.2, 1.0, 3.0, 10.0}) {
        const NormalBlend blend = normal_blend(one_gaussian(variance_mm2), sharp_mm);
        EXPECT_GE(blend.lod_bias, 0);
        EXPECT_LE(blend.lod_bias, 3);
        if (blend.lod_bias > 0) {
            EXPECT_LE(sharp_mm * std::exp2(blend.lod_bias), 0.5 * std::sqrt(12 * variance_mm2) * 1.0001);
        }
    }
}

// The published shader reads three levels up whatever the texel's size; the blend stops at what red scatters.
TEST(NormalBlend, as_published_reads_three_levels_up) {
    for (const double sharp_mm : {0.01, 0.2, 3.0}) {
        const NormalBlend published = published_normal_blend(gpu_gems_3_skin(), sharp_mm);
        EXPECT_EQ(published.lod_bias, 3) << sharp_mm;
        EXPECT_GE(published.weight[0], published.weight[2]) << sharp_mm;
    }
    EXPECT_LT(normal_blend(gpu_gems_3_skin(), 1).lod_bias, 2);
}

TEST(NormalBlend, is_the_best_weight_from_0_to_1_for_ridges) {
    // The squared distance between what scatters and what the blend makes, on a fine grid of wave numbers k;
    // the power of relief falls as 1 / k^2.
    const GaussianSum profile = gpu_gems_3_skin();
    const double sharp_mm = 0.2;
    const NormalBlend blend = normal_blend(profile, sharp_mm);
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

// Where the mean normal turns away from the light and half of the bumps do not: a mean of clamped cosines is
// more than the clamped cosine of a mean.
TEST_F(Lerp, of_normals_loses_light_of_bumps_that_the_blend_keeps) {
    const Image sharp = stripes("sharp"), smooth = stripes("smooth"), blended = stripes("blended"),
                lerp = stripes("lerp");
    int lit = 0;
    for (int x = kGrid / 4; x < kGrid / 2 - 6; ++x) {
        if (sharp.at(x, 1, 1) < 0.2f) continue;
        ++lit;
        EXPECT_LT(smooth.at(x, 1, 1), 0.02f) << x;
        EXPECT_LT(lerp.at(x, 1, 1), 0.97f * blended.at(x, 1, 1)) << x;
        EXPECT_GT(lerp.at(x, 1, 2), smooth.at(x, 1, 2)) << "blue keeps more of the sharp normal";
    }
    EXPECT_GT(lit, 3);
}

// Of two stripes, one that leans towards the light and one that leans away, the blend has the light of both:
// where light grazes too, and the stripe that leans away has none.
TEST_F(Lerp, of_light_keeps_the_sum_of_what_bumps_take_in) {
    const Image sharp = stripes("sharp"), blended = stripes("blended");
    double even = 0, uneven = 0;
    for (int x = kGrid * 3 / 8; x < kGrid * 7 / 8; x += 2) {
        const double light = double(sharp.at(x, 1, 0) + sharp.at(x + 1, 1, 0));
        EXPECT_NEAR(double(blended.at(x, 1, 0) + blended.at(x + 1, 1, 0)), light, 0.2 * light) << x;
        even += std::abs(double(blended.at(x, 1, 0) - blended.at(x + 1, 1, 0)));
        uneven += std::abs(double(sharp.at(x, 1, 0) - sharp.at(x + 1, 1, 0)));
    }
    EXPECT_LT(even, 0.3 * uneven);
}

TEST_F(Lerp, without_bumps_is_the_blend) {
    const Scene scene = make_grid_scene();
    EXPECT_LT(relative_difference(draw_grid(scene, {{"normals", "lerp"}}),
                                  draw_grid(scene, {{"normals", "blended"}}), 1),
              1e-4);
}
