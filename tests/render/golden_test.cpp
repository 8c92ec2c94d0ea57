// Small pictures of every technique, compared with those in tests/golden/.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "render/render_test.h"
#include "support/built_in.h"
#include "support/golden.h"

using namespace dermis;

namespace {

class Goldens : public RenderTest {
  protected:
    static Image picture(Renderer& renderer, const Technique& technique, const DrawSettings& settings) {
        const auto drawn = renderer.draw(technique, ParameterValues(technique.parameters), settings);
        EXPECT_TRUE(drawn) << technique.id << ": " << drawn.error().message;
        Result<Image> display = renderer.display();
        EXPECT_TRUE(display) << display.error().message;
        display->encoding = Encoding::srgb;
        return std::move(*display);
    }

    static void expect_goldens_of(const std::string& scene_name, const DrawSettings& settings,
                                  const GoldenTolerance& tolerance) {
        const Scene scene = load(scene_name);
        Renderer renderer = make_renderer(scene);
        for (const Technique& technique : built_in_catalog().techniques)
            EXPECT_TRUE(matches_golden(picture(renderer, technique, settings),
                                       scene_name + "_" + technique.id, tolerance));
    }
};

const DrawSettings kSpheresSettings = {.width = 192, .height = 128, .shadow_map_size = 1024};
const DrawSettings kBustSettings = {.width = 160, .height = 192, .shadow_map_size = 1024};

// SwiftShader, a Vulkan driver independent of Mesa, as Debian's Chromium carries it (docs/drivers.md).
constexpr const char* kSwiftShaderManifest = "/usr/lib/chromium/vk_swiftshader_icd.json";

class SwiftShaderGoldens : public Goldens {
  protected:
    static void SetUpTestSuite() {
        if (!skip_reason().empty()) return;
        // The loader reads both when the instance is made. Goldens and SwiftShader may run in one process.
        setenv("VK_DRIVER_FILES", kSwiftShaderManifest, 1);
        setenv("VK_ICD_FILENAMES", kSwiftShaderManifest, 1);
        close_device();
        open_device({.validation = true});
        unsetenv("VK_DRIVER_FILES");
        unsetenv("VK_ICD_FILENAMES");
    }
    static void TearDownTestSuite() { close_device(); }
    void SetUp() override {
        if (const std::string reason = skip_reason(); !reason.empty()) GTEST_SKIP() << reason;
        Goldens::SetUp();
        EXPECT_THAT(device().info().name, testing::HasSubstr("SwiftShader"));
    }

  private:
    static std::string skip_reason() {
        if (std::getenv("DERMIS_UPDATE_GOLDENS")) return "goldens are pictures of lavapipe";
        if (!std::filesystem::exists(kSwiftShaderManifest))
            return std::string("no ") + kSwiftShaderManifest + " (Debian: apt-get install chromium)";
        return {};
    }
};

}  // namespace

TEST_F(Goldens, of_the_spheres_with_every_technique) {
    // Without the gain the spheres are off by 0.117 codes.
    expect_goldens_of("spheres", kSpheresSettings, {.mean_codes = 0.1, .outlier_share = 0.001});
}

TEST_F(Goldens, of_the_views_of_the_spheres) {
    const Scene scene = load("spheres");
    Renderer renderer = make_renderer(scene);
    const Technique& technique = built_in_technique("lambert");
    for (const char* view : {"normal", "curvature", "shadow", "n_dot_l", "specular"})
        EXPECT_TRUE(matches_golden(
            picture(renderer, technique, {.width = 128, .height = 96, .view = view, .shadow_map_size = 512}),
            std::string("view_") + view));
}

// The mesh behind this picture comes from 10^7 evaluations of a field: a last digit that another libm rounds
// differently may flip a triangle's diagonal, so more edges may differ than on the spheres.
TEST_F(Goldens, of_the_bust_with_every_technique) {
    expect_goldens_of("bust", kBustSettings, {.mean_codes = 0.8, .outlier_share = 0.01});
}

// Measured on SwiftShader 5.0.0 (Chromium 156): at most 0.018 codes and 0.02 % (texture_space,
// texture_space_gaussians).
TEST_F(SwiftShaderGoldens, of_the_spheres_with_every_technique) {
    expect_goldens_of("spheres", kSpheresSettings, {.mean_codes = 0.05, .outlier_share = 0.0005});
}

// At most 0.40 codes and 0.09 % (texture_space_gaussians): lavapipe decodes the albedo map 0.5 % too dark.
TEST_F(SwiftShaderGoldens, of_the_bust_with_every_technique) {
    expect_goldens_of("bust", kBustSettings, {.mean_codes = 0.6, .outlier_share = 0.002});
}

// Above 65504 a half float is infinite, on SwiftShader NaN, and lavapipe stores 65504.
TEST_F(SwiftShaderGoldens, light_beyond_half_floats_stays_finite_where_it_is_blurred) {
    Scene scene = load("spheres");
    scene.lights[0].intensity = 1.5e5f;  // its radiance on white skin fits into a half float
    Renderer renderer = make_renderer(scene);
    for (const char* id :
         {"texture_space", "texture_space_gaussians", "screen_space_separable", "screen_space_burley"}) {
        const Image light =
            radiance(renderer, built_in_technique(id), {.width = 96, .height = 64, .shadow_map_size = 256});
        size_t broken = 0;
        for (int y = 0; y < light.height; ++y)
            for (int x = 0; x < light.width; ++x) broken += !std::isfinite(light.at(x, y, 0));
        EXPECT_EQ(broken, 0u) << id;
    }
}
