// Light from all around: by which normals it is computed, and how its occlusion scatters.

#include <gtest/gtest.h>

#include "render/grid_scene.h"
#include "techniques/preintegrated/weights.h"

using namespace dermis;

namespace {

class PreintegratedAmbient : public PreintegratedTest {};

}  // namespace

TEST_F(PreintegratedAmbient, uses_the_smoothed_normals) {
    Scene scene = make_studio_grid_scene();
    scene.objects[0].mesh.materials[0].normal_map = striped_normal_map();
    const Image sharp = draw_grid(scene, {{"normals", "sharp"}}),
                smooth = draw_grid(scene, {{"normals", "smooth"}}),
                blended = draw_grid(scene, {{"normals", "blended"}});
    EXPECT_NE(sharp.bytes, smooth.bytes);
    EXPECT_NE(sharp.bytes, blended.bytes);
    EXPECT_NE(smooth.bytes, blended.bytes);
}

// The left half of a plane sees everything around it, the right half nothing. The reference is the profile's
// cumulative distribution along a line, a sum of error functions.
TEST_F(PreintegratedAmbient, scatters_over_an_edge_of_its_occlusion) {
    Scene scene = make_studio_grid_scene();
    Mesh& mesh = scene.objects[0].mesh;
    mesh = make_plane(64, 64, 192);
    mesh.materials[0].base_color_linear = {1, 1, 1};
    for (const Vec3 p : mesh.positions_mm) mesh.occlusions.push_back(p.x < 0.01f ? 1.0f : 0.0f);
    const Image image = draw_grid(scene, {});
    const int row = kGrid / 2;
    for (int x = kGrid / 2 - 6; x < kGrid / 2 + 6; ++x) {
        const double x_mm = x + 0.5 - kGrid / 2;
        for (int c = 0; c < 3; ++c) {
            double expected = 0, total = 0;
            for (const GaussianTerm& term : gpu_gems_3_skin().terms) {
                expected += term.weight[size_t(c)] * 0.5 *
                            std::erfc((x_mm - 0.17) / std::sqrt(2 * term.variance_mm2));
                total += term.weight[size_t(c)];
            }
            EXPECT_NEAR(image.at(x, row, c) / image.at(4, row, c), expected / total, 0.05)
                << x_mm << " " << c;
        }
    }
    const int dark = kGrid / 2 + 1;  // 1.5 mm behind the edge
    EXPECT_GT(image.at(dark, row, 0) / image.at(4, row, 0), 0.08);
    EXPECT_LT(image.at(dark, row, 2) / image.at(4, row, 2), 0.02);
}

TEST(OcclusionBlend, gives_a_gaussian_of_a_stored_variance_to_that_blur) {
    for (const auto& [variance_mm2, expected] : {std::pair{0.5, std::array{1.0, 0.0, 0.0}},
                                                 {2.0, std::array{0.0, 1.0, 0.0}},
                                                 {8.0, std::array{0.0, 0.0, 1.0}},
                                                 {30.0, std::array{0.0, 0.0, 1.0}},
                                                 {0.0, std::array{0.0, 0.0, 0.0}},
                                                 {1.25, std::array{0.5, 0.5, 0.0}}}) {
        const auto weights =
            preintegrated::occlusion_blend({.terms = {{.variance_mm2 = variance_mm2, .weight = {2, 2, 2}}}});
        for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(weights[i][1], expected[i], 1e-12) << variance_mm2;
    }
}
