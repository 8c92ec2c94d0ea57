// diffuse=closed_form and diffuse=curve_2015: no table is bound, and what replaces the tables is near them.

#include <gtest/gtest.h>

#include "dermis/gpu/reflection.h"
#include "render/grid_scene.h"
#include "support/built_in.h"

using namespace dermis;

namespace {

constexpr double kCode = 1.0 / 255;
const Settings kClosed = {{"diffuse", "closed_form"}};

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
                                     {{"shadow", "plain"}}}) {
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
    EXPECT_LT(difference(make_studio_grid_scene(), {}, kClosed), kCode);
}

TEST_F(Textureless, bumps_are_blended_by_the_weights_of_the_table) {
    Scene scene = make_grid_scene();
    scene.lights[0].to_light_world = {0.8f, 0.6f, 0};
    scene.objects[0].mesh.materials[0].normal_map = striped_normal_map();
    EXPECT_LT(difference(scene, {}, kClosed), 2 * kCode);
    EXPECT_GT(difference(scene, {{"normals", "sharp"}}, kClosed), 10 * kCode) << "bumps matter here";
}

TEST_F(Textureless, shadow_edges_are_those_of_the_table) {
    const Scene scene = make_wall_and_bar(5, 8);
    EXPECT_LT(difference(scene, {{"shadow", "scattered"}}, kClosed), 2 * kCode);
    EXPECT_GT(difference(scene, {{"shadow", "plain"}}, kClosed), 10 * kCode) << "an edge is in the picture";
}
