// Lights of every kind and number, the environment, occlusion, and the specular table.

#include <gtest/gtest.h>

#include "dermis/bake/beckmann_table.h"
#include "dermis/bake/table_io.h"
#include "dermis/optics/preintegration.h"
#include "dermis/optics/presets.h"
#include "render/grid_scene.h"
#include "support/built_in.h"
#include "support/temporary_directory.h"

using namespace dermis;

namespace {

constexpr int kLit = kGrid * 3 / 4, kMiddle = kGrid / 2;

class PreintegratedLights : public PreintegratedTest {
  protected:
    // One light, 2 m away unless told otherwise, so that it is nearly distant.
    static Scene lit_by(Light light) {
        Scene scene = make_grid_scene();
        scene.lights = {std::move(light)};
        return scene;
    }
    static Light point_at(float distance_mm) {
        return {
            .name = "point", .kind = LightKind::point, .intensity = 1, .position_mm = {distance_mm, 0, 0}};
    }
    static double red(const Image& image, int x = kLit, int y = kMiddle) { return image.at(x, y, 0); }
};

const Settings kPlain = {{"shadow", "plain"}, {"specular", "none"}};

}  // namespace

TEST_F(PreintegratedLights, that_are_points_fall_off_with_the_square_of_the_distance) {
    const double near = red(draw_grid(lit_by(point_at(2000)), kPlain)),
                 far = red(draw_grid(lit_by(point_at(4000)), kPlain));
    EXPECT_NEAR(near / far, 4, 0.1) << "up to the tile's own place";
    // A distant light of the irradiance that 1 at 2 m makes.
    Scene directional = make_grid_scene();
    directional.lights[0].intensity = 1 / (2.0f * 2.0f);
    EXPECT_NEAR(near / red(draw_grid(directional, kPlain)), 1, 0.05);
}

TEST_F(PreintegratedLights, that_are_spots_shine_within_their_cone_only) {
    // The column shaded is 184 mm from the light; its tiles lie up to 32 mm off the axis.
    Light spot = point_at(200);
    spot.kind = LightKind::spot;
    spot.to_light_world = {1, 0, 0};
    spot.inner_angle_rad = 0.05f;   // 9 mm
    spot.outer_angle_rad = 0.125f;  // 23 mm
    const Image cone = draw_grid(lit_by(spot), kPlain), all = draw_grid(lit_by(point_at(200)), kPlain);
    EXPECT_NEAR(red(cone, kLit, kMiddle) / red(all, kLit, kMiddle), 1, 1e-3);
    EXPECT_EQ(red(cone, kLit, 2), 0) << "30 mm off the axis";
    EXPECT_GT(red(cone, kLit, kMiddle + 16), 0);
    EXPECT_LT(red(cone, kLit, kMiddle + 16), 0.9 * red(all, kLit, kMiddle + 16));
}

TEST_F(PreintegratedLights, add_up_however_many_they_are) {
    Light spot = point_at(3000);
    spot.kind = LightKind::spot;
    spot.to_light_world = {1, 0, 0};
    spot.inner_angle_rad = 0.3f, spot.outer_angle_rad = 0.5f;
    const Light directional = {.name = "sun", .intensity = 2, .to_light_world = {0.6f, 0.8f, 0}};
    Scene all = make_grid_scene();
    all.lights = {point_at(2000), spot, directional, point_at(5000)};
    const Image together = draw_grid(all, kPlain);
    double sum = 0;
    for (const Light& light : all.lights) sum += red(draw_grid(lit_by(light), kPlain), kLit, 50);
    EXPECT_NEAR(red(together, kLit, 50), sum, 1e-4 * sum);
}

TEST_F(PreintegratedLights, from_the_environment_are_the_librarys_harmonics_by_table_and_by_closed_form) {
    Scene scene = make_studio_grid_scene();
    const Result<EnvironmentLight> light = prepare_environment(scene.environment);
    ASSERT_TRUE(light);
    struct Case {
        const char *ambient, *diffuse;
        Preintegration how;
        double tolerance;
    };
    for (const Case& c : {Case{"exact", "lut", {}, 3e-5},
                          {"profile", "lut", {}, 2e-4},
                          {"profile", "half_ring", kUnity2011Ring, 2e-4},
                          {"profile", "full_ring", kYeung2015Ring, 2e-4}}) {
        const Image image = draw_grid(scene, {{"ambient", c.ambient}, {"diffuse", c.diffuse}});
        double largest = 0;
        for (int y = 0; y < kGrid; ++y) {
            const auto zh =
                preintegrated_zonal_harmonics(gpu_gems_3_skin(), 1 / grid_curvature_per_mm(y), c.how);
            for (int x = 0; x < kGrid; x += 3) {
                const std::array<float, 9> basis = sh_basis(grid_normal(x));
                double expected = 0;
                for (size_t i = 0; i < 9; ++i) {
                    const size_t l = i == 0 ? 0 : i < 4 ? 1 : 2;
                    expected += std::sqrt(4 * 3.14159265358979 / double(2 * l + 1)) * zh[l][0] *
                                double(basis[i]) * double(light->radiance_sh[i].x);
                }
                largest = std::max(largest, std::abs(red(image, x, y) - expected / 3.14159265358979));
            }
        }
        EXPECT_LT(largest, c.tolerance) << c.ambient << ", " << c.diffuse;
    }
}

TEST_F(PreintegratedLights, from_the_environment_differ_with_the_published_curves_at_small_radii) {
    Scene scene = make_studio_grid_scene();
    const Image exact = draw_grid(scene, {{"ambient", "exact"}}),
                curve = draw_grid(scene, {{"ambient", "curve_2015"}});
    const double tight = red(curve, kMiddle, kGrid - 1) / red(exact, kMiddle, kGrid - 1),
                 flat = red(curve, kMiddle, 8) / red(exact, kMiddle, 8);
    EXPECT_GT(tight, 1.05) << "the ring they were fitted to does not conserve energy";
    EXPECT_NEAR(flat, 1, 0.03);
}

TEST_F(PreintegratedLights, from_the_environment_are_dimmed_by_an_occlusion_map) {
    Scene scene = make_studio_grid_scene();
    const double open = red(draw_grid(scene, {}));
    scene.objects[0].mesh.materials[0].occlusion_map = {
        .name = "half", .width = 1, .height = 1, .channels = 1, .pixels = {std::byte{128}}};
    EXPECT_NEAR(red(draw_grid(scene, {})) / open, 128.0 / 255, 1e-3);
}

// A user's texture, here the published 8-bit one, and one whose values are doubled: light is proportional to
// them.
TEST_F(PreintegratedLights, are_reflected_by_the_beckmann_table_of_the_scene) {
    Scene scene = load("builtin:spheres");
    scene.environment.kind = EnvironmentKind::none;
    const TemporaryDirectory directory;
    const auto drawn = [&] {
        Renderer renderer = make_renderer(scene);
        return radiance(renderer, technique(), values_of({{"specular", "ksk"}, {"normals", "blended"}}),
                        {.width = 128, .height = 128, .view = "specular", .deep = true});
    };
    const Image baked_here = drawn();
    const auto brightest = [](const Image& image) {
        float most = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) most = std::max(most, image.at(x, y, 0));
        return most;
    };
    Table table = *bake_beckmann({.layout = BeckmannLayout::gems_8_bit});
    const auto with_table = [&](const std::string& name, TableStorage storage) {
        scene.skin.beckmann_table = (directory.path / name).string();
        EXPECT_TRUE(write_table(scene.skin.beckmann_table, table, storage));
        return drawn();
    };
    EXPECT_NEAR(brightest(with_table("published.png", TableStorage::u8)) / brightest(baked_here), 0.88, 0.02)
        << "too coarse over N.H for the peak";
    table = *bake_beckmann({});
    const float own = brightest(with_table("own.exr", TableStorage::f32));
    for (float& value : table.data) value *= 2;
    EXPECT_NEAR(brightest(with_table("doubled.exr", TableStorage::f32)) / own, 2, 0.02);
}

TEST_F(PreintegratedLights, are_reflected_by_the_beckmann_table_as_by_its_formula) {
    // Lambert's ksk evaluates the distribution.
    Scene scene = load("builtin:spheres");
    for (const float roughness : {0.25f, 0.45f, 0.7f}) {
        for (SceneObject& object : scene.objects) object.mesh.materials[0].roughness = roughness;
        Renderer renderer = make_renderer(scene);
        const Technique& lambert = built_in_technique("lambert");
        ParameterValues formula(lambert.parameters);
        ASSERT_TRUE(formula.set("specular", "ksk"));
        const DrawSettings settings = {.width = 128, .height = 128, .view = "specular", .deep = true};
        const Image expected = radiance(renderer, lambert, formula, settings);
        const Image table = radiance(renderer, technique(), values_of({{"specular", "ksk"}}), settings);
        double largest = 0, brightest = 0;
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 128; ++x) {
                largest = std::max(largest, double(std::abs(table.at(x, y, 0) - expected.at(x, y, 0))));
                brightest = std::max(brightest, double(expected.at(x, y, 0)));
            }
        EXPECT_LT(largest, 0.005 * brightest) << roughness;
        EXPECT_GT(brightest, 0.01);
    }
}
