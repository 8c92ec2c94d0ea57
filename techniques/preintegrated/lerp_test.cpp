// normals=lerp, the published mix of the normals themselves, beside the default, which mixes their light.

#include <gtest/gtest.h>

#include "render/grid_scene.h"

using namespace dermis;

namespace {

// Stripes as wide as a pixel that lean towards the light and away from it.
Scene striped_scene() {
    Scene scene = make_grid_scene();
    scene.lights[0].to_light_world = {0.6f, 0, 0.8f};
    ImageSource map{.name = "stripes", .width = 256, .height = 256, .channels = 3};
    for (int i = 0; i < 256 * 256; ++i)
        for (const int value : {(i / 4) % 2 ? 190 : 65, 127, 215}) map.pixels.push_back(std::byte(value));
    scene.objects[0].mesh.materials[0].normal_map = map;
    return scene;
}

class Lerp : public PreintegratedTest {};

}  // namespace

// Where the mean normal turns away from the light and half of the bumps do not: a mean of clamped cosines is
// more than the clamped cosine of a mean.
TEST_F(Lerp, of_normals_loses_light_of_bumps_that_the_blend_keeps) {
    const Scene scene = striped_scene();
    const auto drawn = [&](const char* normals) {
        return draw_grid(scene, {{"shadow", "plain"}, {"normals", normals}});
    };
    const Image sharp = drawn("sharp"), smooth = drawn("smooth"), blended = drawn("blended"),
                lerp = drawn("lerp");
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
    const Scene scene = striped_scene();
    const auto drawn = [&](const char* normals) {
        return draw_grid(scene, {{"shadow", "plain"}, {"normals", normals}});
    };
    const Image sharp = drawn("sharp"), blended = drawn("blended");
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
