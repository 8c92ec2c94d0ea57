#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "dermis/optics/preintegration.h"
#include "render/grid_scene.h"

using namespace dermis;

namespace {

constexpr std::array<double, 4> kRadiiMm = {2, 4, 8, 16};

class SphericalGaussians : public GridTest {
  protected:
    static Image draw(const char* lobes, const char* width = "deviation") {
        return draw_curved(make_grid_scene(), lobes, width);
    }
    static Image draw_curved(const Scene& scene, const char* lobes, const char* width = "deviation") {
        return draw_grid(scene, built_in_technique("spherical_gaussians"),
                         {{"lobes", lobes}, {"width", width}, {"specular", "none"}});
    }
    /// The grid with this curvature everywhere.
    static Scene scene_of(float curvature_per_mm) {
        Scene scene = make_grid_scene();
        Mesh& mesh = scene.objects[0].mesh;
        for (size_t i = 0; i < mesh.normals.size(); ++i)
            mesh.curvatures_per_mm[i] = isotropic_curvature(curvature_per_mm, mesh.normals[i]);
        return scene;
    }

    /// The largest difference from the integral over the sphere at each of kRadiiMm, over N.L, in red.
    static std::array<double, 4> errors(const char* lobes, const char* width = "deviation") {
        Scene scene = make_grid_scene();
        Mesh& mesh = scene.objects[0].mesh;
        const size_t row = mesh.normals.size() / kGrid;
        for (size_t i = 0; i < mesh.normals.size(); ++i)
            mesh.curvatures_per_mm[i] = isotropic_curvature(
                float(1 / kRadiiMm[std::min(i / row, kRadiiMm.size() - 1)]), mesh.normals[i]);
        const Image image = draw_curved(scene, lobes, width);
        std::array<double, 4> worst = {};
        for (size_t y = 0; y < worst.size(); ++y) {
            for (int x = 0; x < kGrid; ++x) {
                const double exact = preintegrated_diffuse(gpu_gems_3_skin(), grid_cosine(x), kRadiiMm[y])[0];
                worst[y] = std::max(worst[y], std::abs(double(image.at(x, int(y), 0)) - exact));
            }
            RecordProperty(std::string("error_") + lobes + width + std::to_string(int(kRadiiMm[y])),
                           std::to_string(worst[y]));
        }
        return worst;
    }
};

}  // namespace

// Radii of 2, 4, 8 and 16 mm. With the profile's variance, as a first try would have it, one lobe is as far
// off as these figures, which were computed independently of this code. The grid does not have the terminator
// itself. With Hill's own bend at every sharpness: .109, .047, .024, .011.
TEST_F(SphericalGaussians, one_of_the_profiles_variance_is_off_by_what_was_computed) {
    const std::array<double, 4> error = errors("1", "variance"), computed = {.109, .0357, .0161, .0068};
    for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(error[i], computed[i], 0.0025) << kRadiiMm[i];
}

TEST_F(SphericalGaussians, of_the_profiles_deviation_are_near_the_best_of_their_number) {
    const std::array<double, 4> one = errors("1"), two = errors("2"), six = errors("6");
    constexpr std::array<double, 4> kOne = {.047, .032, .012, .006}, kTwo = {.012, .007, .004, .002},
                                    kSix = {.005, .003, .0025, .0015};
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_LT(one[i], kOne[i]) << kRadiiMm[i];
        EXPECT_LT(two[i], kTwo[i]) << kRadiiMm[i];
        EXPECT_LT(six[i], kSix[i]) << kRadiiMm[i];
    }
}

TEST_F(SphericalGaussians, keep_the_energy_of_every_colour_at_every_curvature) {
    for (const char* lobes : {"1", "2", "6"}) {
        const Image image = draw(lobes);
        for (int y = 0; y < kGrid; y += 7)
            for (int c = 0; c < 3; ++c) {
                double sum = 0;
                for (int x = 0; x < kGrid; ++x) sum += double(image.at(x, y, c));
                EXPECT_NEAR(sum / kGrid, 0.25, 0.003) << lobes << " lobes, row " << y << ", channel " << c;
            }
    }
}

// Against the integral over the sphere, for the curvatures of spheres of 1 to 16 mm.
TEST_F(SphericalGaussians, are_nearer_to_the_profile_than_lambert_in_every_colour_at_every_curvature) {
    for (const char* lobes : {"1", "2"}) {
        const Image image = draw(lobes);
        for (int y = 3; y < kGrid; y += 4)
            for (int c = 0; c < 3; ++c) {
                double own = 0, lambert = 0;
                for (int x = 0; x < kGrid; ++x) {
                    const double t = grid_cosine(x), cosine = std::max(t, 0.0);
                    const double exact =
                        preintegrated_diffuse(gpu_gems_3_skin(), t, 1 / grid_curvature_per_mm(y))[size_t(c)];
                    own += std::pow(double(image.at(x, y, c)) - exact, 2);
                    lambert += std::pow(cosine - exact, 2);
                }
                EXPECT_LT(own, lambert)
                    << lobes << " lobes, " << grid_curvature_per_mm(y) << " per mm, " << c;
            }
    }
}

TEST_F(SphericalGaussians, on_flat_skin_are_lambert) {
    const Image image = draw_curved(scene_of(0), "2");
    for (int x = 0; x < kGrid; ++x) EXPECT_NEAR(image.at(x, 0, 0), std::max(grid_cosine(x), 0.0), 2e-4) << x;
}

// A lobe that is as wide as the sphere: the light is the same everywhere.
TEST_F(SphericalGaussians, of_skin_far_smaller_than_the_profile_are_constant) {
    const Image image = draw_curved(scene_of(200), "2");
    for (int x = 0; x < kGrid; ++x) EXPECT_NEAR(image.at(x, 0, 0), 0.25, 0.01) << x;
}
