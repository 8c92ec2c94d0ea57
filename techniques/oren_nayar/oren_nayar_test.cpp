#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dermis/base/text.h"
#include "render/grid_scene.h"

using namespace dermis;

namespace {

const Vec3 kToLight = {0.6f, 0, 0.8f};

// Over x the angle between the normal and the camera's axis, 0 to 85 degrees; over y the azimuth, all around.
Vec3 normal_at(int x, int y) {
    const double polar = 85 * M_PI / 180 * x / (kGrid - 1), azimuth = 2 * M_PI * y / kGrid;
    return {float(std::sin(polar) * std::cos(azimuth)), float(std::sin(polar) * std::sin(azimuth)),
            float(std::cos(polar))};
}

Scene normals_all_around(Vec3 to_light) {
    Scene scene = make_grid_scene();
    for (int y = 0; y < kGrid; ++y)
        for (int x = 0; x < kGrid; ++x)
            for (int corner = 0; corner < 4; ++corner)
                scene.objects[0].mesh.normals[size_t((y * kGrid + x) * 4 + corner)] = normal_at(x, y);
    scene.lights[0].to_light_world = to_light;
    return scene;
}

Vec3 to_eye_at(int x, int y) {
    return normalize(Vec3{0, 0, 1000} - Vec3{float(x - kGrid / 2) + 0.5f, float(kGrid / 2 - y) - 0.5f, 0});
}

double angle(Vec3 a, Vec3 b) {
    return std::acos(std::clamp(double(dot(a, b)), -1.0, 1.0));
}

// Equation 30 of the paper, in its own angles: of the diffuse term, which is n.l for Lambert.
double published(Vec3 n, Vec3 l, Vec3 v, double sigma) {
    const double incident = angle(n, l), reflected = angle(n, v);
    const Vec3 l_flat = l - n * dot(n, l), v_flat = v - n * dot(n, v);
    const double cos_azimuth = dot(l_flat, v_flat) / std::max(length(l_flat) * length(v_flat), 1e-9f);
    const double s2 = sigma * sigma, a = 1 - 0.5 * s2 / (s2 + 0.33), b = 0.45 * s2 / (s2 + 0.09);
    return std::cos(incident) *
           (a + b * std::max(0.0, cos_azimuth) * std::sin(std::max(incident, reflected)) *
                    std::tan(std::min(incident, reflected)));
}

class OrenNayar : public GridTest {
  protected:
    static Image draw(Vec3 to_light, const std::string& sigma_rad) {
        return draw_grid(normals_all_around(to_light), built_in_technique("oren_nayar"),
                         {{"specular", "none"}, {"facet_sigma_rad", sigma_rad}});
    }
};

class OrenNayarEvenLight : public RenderTest {};

// Oren, Nayar 1994, equation 30, over the light's polar angle and azimuth, over Lambert's pi.
double summed_response(double eye_angle, double sigma) {
    const double s2 = sigma * sigma, a = 1 - 0.5 * s2 / (s2 + 0.33), b = 0.45 * s2 / (s2 + 0.09);
    constexpr int kSteps = 400;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const double polar = M_PI / 2 * (i + 0.5) / kSteps, azimuth = 2 * M_PI * (j + 0.5) / kSteps;
            const double alpha = std::max(polar, eye_angle), beta = std::min(polar, eye_angle);
            const double response =
                a + b * std::max(0.0, std::cos(azimuth)) * std::sin(alpha) * std::tan(beta);
            sum += response * std::cos(polar) * std::sin(polar);
        }
    return sum * (M_PI / 2 / kSteps) * (2 * M_PI / kSteps) / M_PI;
}

}  // namespace

TEST_F(OrenNayar, is_the_papers_formula) {
    for (const double sigma : {0.0, 0.35, 0.8}) {
        const Image image = draw(kToLight, to_text(sigma));
        size_t lit = 0;
        for (int y = 0; y < kGrid; ++y)
            for (int x = 0; x < kGrid; ++x) {
                const Vec3 n = normal_at(x, y), v = to_eye_at(x, y);
                if (dot(n, kToLight) < 0.02f || dot(n, v) < 0.02f) continue;
                ++lit;
                EXPECT_NEAR(image.at(x, y, 1), published(n, kToLight, v, sigma), 2e-3)
                    << "sigma " << sigma << " at " << x << " " << y;
            }
        EXPECT_GT(lit, 2500u);
    }
}

TEST_F(OrenNayar, is_flatter_than_lambert_towards_grazing_angles_under_light_from_the_viewer) {
    const Image rough = draw({0, 0, 1}, "0.5"), lambert = draw({0, 0, 1}, "0");
    const auto kept = [](const Image& image) {
        const int grazing = kGrid * 75 / 85;
        return image.at(grazing, 0, 1) / image.at(0, 0, 1);
    };
    EXPECT_LT(rough.at(0, 0, 1), 0.85f * lambert.at(0, 0, 1));
    EXPECT_GT(kept(rough), 1.5f * kept(lambert));
}

// An environment of constant radiance: the closed form against the model summed over the hemisphere of
// lights.
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
