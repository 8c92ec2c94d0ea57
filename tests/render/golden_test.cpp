// Small pictures of every technique, compared with those in tests/golden/.

#include <gtest/gtest.h>

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
};

}  // namespace

TEST_F(Goldens, of_the_spheres_with_every_technique) {
    const Scene scene = load("spheres");
    Renderer renderer = make_renderer(scene);
    for (const Technique& technique : built_in_catalog().techniques)
        EXPECT_TRUE(matches_golden(
            picture(renderer, technique, {.width = 192, .height = 128, .shadow_map_size = 1024}),
            "spheres_" + technique.id));
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
    const Scene scene = load("bust");
    Renderer renderer = make_renderer(scene);
    for (const Technique& technique : built_in_catalog().techniques)
        EXPECT_TRUE(matches_golden(
            picture(renderer, technique, {.width = 160, .height = 192, .shadow_map_size = 1024}),
            "bust_" + technique.id, {.mean_codes = 0.8, .outlier_share = 0.01}));
}
