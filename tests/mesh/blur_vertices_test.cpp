#include "dermis/mesh/blur_vertices.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "dermis/mesh/primitives.h"

using namespace dermis;

namespace {

Result<std::vector<float>> blurred_by(const Mesh& mesh, std::span<const float> values, double variance_mm2) {
    DERMIS_TRY_ASSIGN(auto blurred, blur_over_surface(mesh, values, std::array{variance_mm2}));
    return std::move(blurred.front());
}

}  // namespace

TEST(BlurOverSurface, damps_a_wave_on_a_plane_by_the_gaussians_factor) {
    // exp(-2 pi^2 v / wavelength^2); two implicit steps have (1 + pi^2 v / wavelength^2)^-2.
    const Mesh mesh = make_plane(40, 40, 80);
    const double wavelength_mm = 10, variance_mm2 = 2;
    std::vector<float> wave;
    for (const Vec3 p : mesh.positions_mm)
        wave.push_back(float(std::cos(2 * 3.14159265 * p.x / wavelength_mm)));
    const auto blurred = blurred_by(mesh, wave, variance_mm2);
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
    const auto same = blurred_by(mesh, std::vector<float>(height.size(), 0.7f), 5);
    const auto blurred = blurred_by(mesh, height, 5);
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
    const auto blurred = blurred_by(mesh, values, 0);
    ASSERT_TRUE(blurred);
    for (size_t i = 0; i < values.size(); ++i) EXPECT_NEAR((*blurred)[i], values[i], 1e-4);
}

TEST(BlurOverSurface, by_several_variances_is_by_each) {
    const Mesh mesh = make_sphere(10, 12);
    std::vector<float> values;
    for (const Vec3 p : mesh.positions_mm) values.push_back(p.y);
    const auto both = blur_over_surface(mesh, values, std::array{8.0, 0.5});
    ASSERT_TRUE(both);
    ASSERT_EQ(both->size(), 2u);
    EXPECT_EQ((*both)[0], *blurred_by(mesh, values, 8));
    EXPECT_EQ((*both)[1], *blurred_by(mesh, values, 0.5));
    EXPECT_NE((*both)[0], (*both)[1]);
}

TEST(FitOverSurface, finds_a_linear_function_from_samples_anywhere_in_the_triangles) {
    const Mesh mesh = make_plane(10, 10, 4);
    std::vector<SurfaceSamples> samples(mesh.triangle_count());
    for (size_t t = 0; t < samples.size(); ++t)
        for (const std::array<float, 3>& w :
             {std::array{0.7f, 0.2f, 0.1f}, std::array{0.1f, 0.1f, 0.8f}, std::array{0.2f, 0.6f, 0.2f}}) {
            Vec3 p;
            for (size_t k = 0; k < 3; ++k) p += mesh.positions_mm[mesh.indices[3 * t + k]] * w[k];
            samples[t].add(w, 1, {p.x, 2 * p.y, 3});
        }
    const auto fitted = fit_over_surface(mesh, samples, 0);
    ASSERT_TRUE(fitted) << fitted.error().message;
    for (size_t i = 0; i < fitted->size(); ++i) {
        EXPECT_NEAR((*fitted)[i].x, mesh.positions_mm[i].x, 1e-2);
        EXPECT_NEAR((*fitted)[i].y, 2 * mesh.positions_mm[i].y, 2e-2);
        EXPECT_NEAR((*fitted)[i].z, 3, 1e-2);
    }
}

TEST(FitOverSurface, of_a_variance_damps_a_wave_and_continues_where_samples_are_missing) {
    const Mesh mesh = make_plane(40, 40, 80);
    const double wavelength_mm = 10, variance_mm2 = 2;
    std::vector<SurfaceSamples> samples(mesh.triangle_count());
    for (size_t t = 0; t < samples.size(); ++t) {
        Vec3 middle;
        for (size_t k = 0; k < 3; ++k) middle += mesh.positions_mm[mesh.indices[3 * t + k]] * (1.0f / 3);
        if (middle.x > 18) continue;
        const auto wave = float(std::cos(2 * 3.14159265 * double(middle.x) / wavelength_mm));
        for (size_t k = 0; k < 3; ++k) {
            std::array<float, 3> corner = {};
            corner[k] = 1;
            samples[t].add(corner, 0.125f / 3, {wave, 1, 0});
        }
    }
    const auto fitted = fit_over_surface(mesh, samples, variance_mm2);
    ASSERT_TRUE(fitted) << fitted.error().message;
    // One implicit step has (1 + 2 pi^2 v / wavelength^2)^-1.
    const double factor = 1 / (1 + 2 * 9.8696 * variance_mm2 / (wavelength_mm * wavelength_mm));
    for (size_t i = 0; i < fitted->size(); ++i) {
        const double x = double(mesh.positions_mm[i].x);
        if (std::abs(x) < 12) {
            EXPECT_NEAR((*fitted)[i].x, factor * std::cos(2 * 3.14159265 * x / wavelength_mm), 0.03);
        }
        EXPECT_NEAR((*fitted)[i].y, 1, 0.02);
    }
}

TEST(FitWithoutNoise, takes_noise_from_even_places_and_leaves_a_bump) {
    const Mesh mesh = make_plane(80, 80, 80);
    std::vector<SurfaceSamples> samples(mesh.triangle_count());
    std::mt19937 random(1);
    const auto bump = [](Vec3 p) { return std::exp(-dot(p, p) / 18); };  // 3 mm wide
    for (size_t t = 0; t < samples.size(); ++t)
        for (int i = 0; i < 4; ++i) {
            const std::array<float, 3> weights = {i == 0 ? 0.6f : 0.2f, i == 1 ? 0.6f : 0.2f,
                                                  i == 0 || i == 1 ? 0.2f : 0.6f};
            Vec3 p;
            for (size_t k = 0; k < 3; ++k) p += mesh.positions_mm[mesh.indices[3 * t + k]] * weights[k];
            const float noise = float(random() % 1000) / 1000 - 0.5f;
            samples[t].add(weights, 0.125f, {bump(p) + noise, 1, 0}, i % 2 == 1);
        }
    const auto plain = fit_over_surface(mesh, samples, 1);
    const auto clean = fit_without_noise(mesh, samples);
    ASSERT_TRUE(plain && clean);
    double plain_error = 0, clean_error = 0, stated = 0;
    for (size_t i = 0; i < mesh.positions_mm.size(); ++i) {
        const Vec3 p = mesh.positions_mm[i];
        const auto square = [&](float value) { return double((value - bump(p)) * (value - bump(p))); };
        EXPECT_NEAR(clean->values[i].y, 1, 1e-3);
        if (length(p) < 2) {
            EXPECT_NEAR(clean->values[i].x, bump(p), 0.15) << p.x << " " << p.y;
        } else if (length(p) > 20) {
            plain_error += square((*plain)[i].x);
            clean_error += square(clean->values[i].x);
            stated += double(clean->noise[i].x * clean->noise[i].x);
        }
    }
    EXPECT_LT(clean_error, plain_error / 9);
    EXPECT_NEAR(std::sqrt(stated / clean_error), 1, 0.5);
}
