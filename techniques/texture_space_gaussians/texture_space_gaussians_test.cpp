// Against what the profile itself makes of a shadow's edge: each Gaussian of the sum turns a step into an
// error function. What both techniques over the atlas share is tested in tests/render/atlas_*.

#include <gtest/gtest.h>

#include <cmath>

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
