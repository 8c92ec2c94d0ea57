// Against what the profile itself makes of a shadow's edge: each Gaussian of the sum turns a step into an
// error function. What both techniques over the atlas share is tested in tests/render/atlas_*.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dermis/optics/conversions.h"
#include "dermis/optics/presets.h"
#include "dermis/rays/curvature_gain.h"
#include "render/shadowed_plane.h"
#include "support/built_in.h"

using namespace dermis;

namespace {

class TextureSpaceGaussians : public RenderTest {};

}  // namespace

TEST_F(TextureSpaceGaussians, the_edge_of_a_shadow_is_the_profiles_own) {
    Scene scene = half_shadowed(plane(one_chart));
    Renderer renderer = make_renderer(scene);
    const Technique& technique = built_in_technique("texture_space_gaussians");
    ParameterValues values = without_gain(ParameterValues(technique.parameters));
    ASSERT_TRUE(values.set("light_map_size", "512"));
    const auto drawn = renderer.draw(
        technique, values, {.width = 32, .height = 32, .shadow_map_size = 2048, .penumbra_mm = 0.05f});
    ASSERT_TRUE(drawn) << drawn.error().message;
    const Image sum = *renderer.read("light_sum");
    const GaussianSum skin = gpu_gems_3_skin();
    for (const float from_edge_mm : {-6.0f, -3.0f, -1.5f, -0.7f, 0.7f, 1.5f, 3.0f, 6.0f}) {
        const Vec2 uv = one_chart({kEdgeMm + from_edge_mm, 0, 0}, false);
        const int x = int(uv.x * 512), y = 256;
        // The middle of that texel, back in mm.
        const double x_mm = ((double(x) + 0.5) / 512 - 0.5) * kSideMm / 0.8 - kEdgeMm;
        for (int c = 0; c < 3; ++c) {
            double expected = 0, total = 0;
            for (const GaussianTerm& term : skin.terms) {
                expected += term.weight[size_t(c)] * 0.5 * std::erfc(x_mm / std::sqrt(2 * term.variance_mm2));
                total += term.weight[size_t(c)];
            }
            EXPECT_NEAR(sum.at(x, y, c) / sum.at(x, y, 3), expected / total, 0.02)
                << x_mm << " mm, channel " << c;
        }
    }
}

// Red of the spheres: past the terminator more light than the profile's, on the lit side less. A product with
// the profile's light would have as much in both.
TEST_F(TextureSpaceGaussians, the_gain_multiplies_light_from_farther_than_the_profiles) {
    const Scene scene = load("builtin:spheres");
    const GainForm form = walked_gain_form(walk_medium_of(*find_profile(scene.skin.profile)));
    Renderer renderer = make_renderer(scene);
    const Technique& technique = built_in_technique("texture_space_gaussians");
    ParameterValues values = without_gain(ParameterValues(technique.parameters));
    ASSERT_TRUE(values.set("transmission", "none"));
    const DrawSettings settings = {
        .width = 96, .height = 96, .view = "diffuse", .gbuffer = true, .shadow_map_size = 512};
    const Image profile = radiance(renderer, technique, values, settings);
    ASSERT_TRUE(values.set("gain", "curvature"));
    const Image both = radiance(renderer, technique, values, settings);
    const Result<Image> normal = renderer.read("gbuffer_normal");
    ASSERT_TRUE(normal) << normal.error().message;
    const Image per_mm = to_linear_float(*normal);  // in alpha
    double of_gain[2] = {0, 0}, of_profile[2] = {0, 0};
    float brightest = 0;
    for (int y = 0; y < profile.height; ++y)
        for (int x = 0; x < profile.width; ++x) brightest = std::max(brightest, profile.at(x, y, 0));
    for (int y = 0; y < profile.height; ++y)
        for (int x = 0; x < profile.width; ++x) {
            const float light = profile.at(x, y, 0);
            const double gain_less_1 = gain(form, 0, per_mm.at(x, y, 3)) - 1;
            const bool lit = light > 0.8f * brightest;
            if (gain_less_1 < 0.05 || (!lit && !(light > 0.01f * brightest && light < 0.2f * brightest)))
                continue;
            of_gain[lit] += (both.at(x, y, 0) - light) / gain_less_1;
            of_profile[lit] += light;
        }
    EXPECT_GT(of_gain[false], 1.05 * of_profile[false]);
    EXPECT_LT(of_gain[true], 0.995 * of_profile[true]);
}
