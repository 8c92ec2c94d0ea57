// diffuse=closed_form and diffuse=curve_2015: no table is bound, and what replaces the tables is near them.

#include <gtest/gtest.h>

#include <cstring>

#include "dermis/gpu/reflection.h"
#include "dermis/mesh/primitives.h"
#include "render/grid_scene.h"
#include "support/built_in.h"

using namespace dermis;

namespace {

constexpr double kCode = 1.0 / 255;

class Textureless : public PreintegratedTest {
  protected:
    // Textures of the shader that draws the skin with these settings.
    static std::vector<std::string> textures(const Settings& settings) {
        const std::string shader = technique().build(values_of(settings), {}).passes.front().shader;
        for (const gpu::EmbeddedShader& embedded : built_in_catalog().shaders) {
            if (embedded.name != shader) continue;
            const auto interface = gpu::reflect(shader, embedded.words);
            EXPECT_TRUE(interface) << shader;
            std::vector<std::string> names;
            for (const gpu::Binding& binding : interface->bindings)
                if (binding.kind == gpu::BindingKind::texture) names.push_back(binding.name);
            return names;
        }
        ADD_FAILURE() << shader << " is not embedded";
        return {};
    }
    static int tables(const Settings& settings) {
        const std::vector<std::string> names = textures(settings);
        EXPECT_GT(names.size(), 5u) << "maps of the material, the environment and shadows";
        return int(std::ranges::count_if(names, [](const auto& name) { return name.starts_with("skin_"); }));
    }
    // Largest difference of two settings, relative to the brightest value.
    static double difference(const Scene& scene, const Settings& a, const Settings& b) {
        const Image first = draw_grid(scene, a), second = draw_grid(scene, b);
        double largest = 0, brightest = 0;
        for (int y = 0; y < kGrid; ++y)
            for (int x = 0; x < kGrid; ++x)
                for (int c = 0; c < 3; ++c) {
                    largest = std::max(largest, double(std::abs(first.at(x, y, c) - second.at(x, y, c))));
                    brightest = std::max(brightest, double(first.at(x, y, c)));
                }
        EXPECT_GT(brightest, 0.05);
        return largest / brightest;
    }
};

}  // namespace

TEST_F(Textureless, settings_bind_no_table) {
    EXPECT_EQ(tables({}), 4) << "the default reads these";
    for (const char* diffuse : {"closed_form", "curve_2015"})
        for (const Settings& more : {Settings{},
                                     {{"ambient", "exact"}},
                                     {{"ambient", "curve_2015"}},
                                     {{"specular", "ksk"}},
                                     {{"normals", "lerp"}},
                                     {{"shadow", "plain"}},
                                     {{"construction", "ring"}}}) {
            Settings settings = more;
            settings.emplace_back("diffuse", diffuse);
            EXPECT_EQ(tables(settings), 0) << diffuse;
            const auto baked = technique().tables(
                values_of(settings),
                {.profile = {.name = "gpu_gems_3", .source = "", .model = gpu_gems_3_skin()},
                 .gaussians = gpu_gems_3_skin()});
            ASSERT_TRUE(baked);
            EXPECT_TRUE(baked->empty()) << "nothing is baked for them either";
        }
}

TEST_F(Textureless, light_from_all_around_is_that_of_the_table) {
    Scene scene = make_grid_scene();
    scene.lights.clear();
    scene.environment = {.kind = EnvironmentKind::studio, .intensity = 1};
    for (const char* construction : {"sphere", "ring"})
        EXPECT_LT(difference(scene, {{"construction", construction}},
                             {{"construction", construction}, {"diffuse", "closed_form"}}),
                  kCode)
            << construction;
}

TEST_F(Textureless, bumps_are_blended_by_the_weights_of_the_table) {
    Scene scene = make_grid_scene();
    scene.lights[0].to_light_world = {0.8f, 0.6f, 0};
    ImageSource map{.name = "stripes", .width = 256, .height = 256, .channels = 3};
    for (int i = 0; i < 256 * 256; ++i)
        for (const int value : {(i / 4) % 2 ? 190 : 65, 127, 215}) map.pixels.push_back(std::byte(value));
    scene.objects[0].mesh.materials[0].normal_map = map;
    const Settings closed = {{"diffuse", "closed_form"}};
    EXPECT_LT(difference(scene, {}, closed), 2 * kCode);
    EXPECT_GT(difference(scene, {{"normals", "sharp"}}, closed), 10 * kCode) << "bumps matter here";
}

TEST_F(Textureless, shadow_edges_are_those_of_the_table) {
    // A wall of 64 mm, of which a bar above it shadows a part.
    Scene scene = make_grid_scene();
    SceneObject& object = scene.objects[0];
    object.mesh = make_plane(64, 64, 2);
    object.mesh.materials[0].base_color_linear = {1, 1, 1};
    object.mesh.occlusions.assign(object.mesh.positions_mm.size(), 1);
    SceneObject bar = object;
    bar.name = "bar";
    for (Vec3& p : bar.mesh.positions_mm) p = {0.3f * p.x + 5, p.y, 8};
    scene.objects.push_back(bar);
    scene.camera = {.eye_mm = {0, 0, 1000}, .vertical_fov_rad = 2 * std::atan(32 / 1000.0f)};
    scene.lights[0] = {.name = "key", .intensity = 3.14159265f, .to_light_world = normalize(Vec3{-1, 0, 1})};
    const Settings closed = {{"diffuse", "closed_form"}};
    EXPECT_LT(difference(scene, {}, closed), 2 * kCode);
    EXPECT_GT(difference(scene, {{"shadow", "plain"}}, closed), 10 * kCode) << "an edge is in the picture";
}
