#include "dermis/mesh/blur_vertices.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/mesh/primitives.h"

using namespace dermis;

TEST(BlurOverSurface, damps_a_wave_on_a_plane_by_the_gaussians_factor) {
    // exp(-2 pi^2 v / wavelength^2); two implicit steps have (1 + pi^2 v / wavelength^2)^-2.
    const Mesh mesh = make_plane(40, 40, 80);
    const double wavelength_mm = 10, variance_mm2 = 2;
    std::vector<float> wave;
    for (const Vec3 p : mesh.positions_mm)
        wave.push_back(float(std::cos(2 * 3.14159265 * p.x / wavelength_mm)));
    const auto blurred = blur_over_surface(mesh, wave, variance_mm2);
    ASSERT_TRUE(blurred) << blurred.error().message;
    const double square = 9.8696 * variance_mm2 / (wavelength_mm * wavelength_mm);
    for (size_t i = 0; i < wave.size(); ++i) {
        EXPECT_NEAR((*blurred)[i], wave[i] / ((1 + square) * (1 + square)), 0.02);
        EXPECT_NEAR((*blurred)[i], wave[i] * std::exp(-2 * square), 0.06);
    }
}

TEST(BlurOverSurface, keeps_a_constant_and_ignores_uv_seams) {
    const Mesh mesh = make_sphere(10, 48);
    std::vector<float> height;
    for (const Vec3 p : mesh.positions_mm) height.push_back(p.x > 0 ? 1.0f : 0.0f);
    const auto same = blur_over_surface(mesh, std::vector<float>(height.size(), 0.7f), 5);
    const auto blurred = blur_over_surface(mesh, height, 5);
    ASSERT_TRUE(same && blurred);
    for (size_t i = 0; i < height.size(); ++i) {
        EXPECT_NEAR((*same)[i], 0.7, 1e-4);
        for (size_t k = 0; k < i; ++k)
            if (mesh.positions_mm[i] == mesh.positions_mm[k]) {
                EXPECT_EQ((*blurred)[i], (*blurred)[k]);
            }
    }
}

TEST(BlurOverSurface, of_no_variance_changes_nothing) {
    const Mesh mesh = make_sphere(10, 12);
    std::vector<float> values;
    for (const Vec3 p : mesh.positions_mm) values.push_back(p.y);
    const auto blurred = blur_over_surface(mesh, values, 0);
    ASSERT_TRUE(blurred);
    for (size_t i = 0; i < values.size(); ++i) EXPECT_NEAR((*blurred)[i], values[i], 1e-4);
}
