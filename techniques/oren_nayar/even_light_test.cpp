// An environment of constant radiance: the shader's closed form against the model summed over the hemisphere
// of lights.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/render_test.h"

using namespace dermis;

namespace {

constexpr double kPi = std::numbers::pi;

class OrenNayarEvenLight : public RenderTest {};

// Oren, Nayar 1994, equation 30, over the light's polar angle and azimuth, over Lambert's pi.
double summed_response(double eye_angle, double sigma) {
    const double s2 = sigma * sigma, a = 1 - 0.5 * s2 / (s2 + 0.33), b = 0.45 * s2 / (s2 + 0.09);
    constexpr int kSteps = 400;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const double polar = kPi / 2 * (i + 0.5) / kSteps, azimuth = 2 * kPi * (j + 0.5) / kSteps;
            const double alpha = std::max(polar, eye_angle), beta = std::min(polar, eye_angle);
            const double response =
                a + b * std::max(0.0, std::cos(azimuth)) * std::sin(alpha) * std::tan(beta);
            sum += response * std::cos(polar) * std::sin(polar);
        }
    return sum * (kPi / 2 / kSteps) * (2 * kPi / kSteps) / kPi;
}

}  // namespace

TEST_F(OrenNayarEvenLight, gives_the_models_sum_over_the_hemisphere) {
    Scene scene = evenly_lit_spheres();
    scene.objects.erase(scene.objects.begin(), scene.objects.begin() + 3);
    Vec3 center_mm;
    const std::vector<Vec3>& positions_mm = scene.objects[0].mesh.positions_mm;
    for (const Vec3 p : positions_mm) center_mm += p * (1.0f / float(positions_mm.size()));
    scene.camera.target_mm = center_mm;
    const Technique& model = built_in_technique("oren_nayar");
    const Technique& lambert = built_in_technique("lambert");
    const DrawSettings settings = {.width = 16, .height = 16, .view = "diffuse", .deep = true};
    for (const double eye_angle : {0.1, 0.8, 1.3}) {
        // All normals point up, so the eye's polar angle is the camera's.
        const Vec3 to_eye = {0, float(std::cos(eye_angle)), float(std::sin(eye_angle))};
        scene.camera.eye_mm = scene.camera.target_mm + to_eye * 1000;
        scene.camera.near_mm = 500;
        scene.camera.far_mm = 1500;
        scene.camera.vertical_fov_rad = 5e-3f;
        Renderer renderer = make_renderer(scene);
        for (const double sigma : {0.1, 0.35, 1.0}) {
            ParameterValues values(model.parameters);
            ASSERT_TRUE(values.set("facet_sigma_rad", std::to_string(sigma)));
            const double ratio = radiance(renderer, model, values, settings).at(8, 8, 0) /
                                 radiance(renderer, lambert, settings).at(8, 8, 0);
            EXPECT_NEAR(ratio, summed_response(eye_angle, sigma), 3e-3) << eye_angle << ", " << sigma;
        }
    }
}
