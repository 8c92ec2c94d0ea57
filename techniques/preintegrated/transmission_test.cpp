// Light through a small sphere from behind: the pole away from the light gets what the sphere's own integral
// says.

#include <gtest/gtest.h>

#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/preintegration.h"
#include "dermis/optics/presets.h"
#include "render/grid_scene.h"
#include "support/built_in.h"

using namespace dermis;

namespace {

class PreintegratedTransmission : public PreintegratedTest {
  protected:
    // The middle of a white sphere whose whole light comes from behind it.
    static Rgb dark_pole(float radius_mm, const std::string& transmission,
                         const std::string& profile = "gpu_gems_3") {
        Result<Scene> scene = load_built_in_scene("builtin:spheres");
        scene->skin.profile = profile;
        EXPECT_TRUE(scene && complete_scene(*scene));
        const auto found = std::ranges::find_if(scene->objects, [&](const SceneObject& object) {
            return std::abs(object.mesh.curvatures_per_mm[0] - 1 / radius_mm) < 0.01f;
        });
        EXPECT_NE(found, scene->objects.end());
        scene->objects = {*found};
        Mesh& mesh = scene->objects[0].mesh;
        mesh.materials[0].base_color_linear = {1, 1, 1};
        Vec3 center_mm;
        for (const Vec3 p : mesh.positions_mm) center_mm += p * (1.0f / float(mesh.positions_mm.size()));
        scene->bounds_center_mm = center_mm;
        scene->bounds_radius_mm = 1.1f * radius_mm;
        scene->environment.kind = EnvironmentKind::none;
        scene->camera.target_mm = center_mm;
        scene->camera.eye_mm = center_mm + Vec3{0, 0, 200};
        Light behind;
        behind.is_key = true;
        behind.intensity = 1;
        behind.to_light_world = {0, 0, -1};
        scene->lights = {behind};
        Renderer renderer = make_renderer(*scene);
        const Image image = radiance(renderer, technique(), values_of({{"transmission", transmission}}),
                                     {.width = 65, .height = 65, .view = "diffuse"});
        Rgb exitance;
        for (int c = 0; c < 3; ++c) exitance[size_t(c)] = std::numbers::pi * double(image.at(32, 32, c));
        return exitance;
    }
};

}  // namespace

// The profiles' own albedo is 1, .44 and .4 in red: it must not enter, since the albedo map multiplies too.
TEST_F(PreintegratedTransmission, through_a_sphere_is_the_sphere_s_integral_for_every_albedo_of_the_profile) {
    for (const char* name : {"gpu_gems_3", "jensen_skin1", "openpbr_skin_5"})
        for (const float radius_mm : {2.0f, 4.0f}) {
            const GaussianSum skin = to_gaussian_sum(*find_profile(name)).sum;
            const Rgb light = dark_pole(radius_mm, "shadow_map", name),
                      exact = preintegrated_diffuse(skin, -1, radius_mm, {});
            EXPECT_GT(light[0], 5e-4) << radius_mm;
            EXPECT_NEAR(light[0] / exact[0], 1, 0.2)
                << name << ", " << radius_mm << " mm: " << light[0] << ", " << exact[0];
        }
}

TEST_F(PreintegratedTransmission, is_none_unless_asked_for) {
    EXPECT_EQ(dark_pole(2, "none"), (Rgb{0, 0, 0}));
}

// scenes/ear.toml, which README draws: the ear must be seen to glow, at a small size too.
TEST_F(PreintegratedTransmission, makes_the_ear_of_the_scene_ear_glow) {
    Result<Scene> scene = load_built_in_scene("ear");
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_TRUE(complete_scene(*scene));
    Renderer renderer = make_renderer(*scene);
    const DrawSettings settings = {.width = 128, .height = 128, .view = "diffuse"};
    const Image without = radiance(renderer, technique(), values_of({{"transmission", "none"}}), settings),
                with = radiance(renderer, technique(), values_of({{"transmission", "shadow_map"}}), settings);
    int glowing = 0;
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x) glowing += with.at(x, y, 0) > 2 * without.at(x, y, 0) + 0.02f;
    EXPECT_GT(glowing, 128 * 128 / 100);
}
