#include <gtest/gtest.h>

#include <cmath>

#include "render/render_test.h"
#include "support/built_in.h"

using namespace dermis;

namespace {

const DrawSettings kSmall = {.width = 128, .height = 128, .view = "diffuse", .shadow_map_size = 512};

class TextureSpace : public RenderTest {
  protected:
    static ParameterValues with(std::initializer_list<std::pair<const char*, const char*>> settings) {
        ParameterValues values(built_in_technique("texture_space").parameters);
        for (const auto& [name, text] : settings) EXPECT_TRUE(values.set(name, text)) << name;
        return values;
    }
    static Image draw(Renderer& renderer, const ParameterValues& values) {
        return radiance(renderer, built_in_technique("texture_space"), values, kSmall);
    }
    static double mean_difference(const Image& a, const Image& b) {
        double sum = 0, count = 0;
        for (int y = 0; y < a.height; ++y)
            for (int x = 0; x < a.width; ++x)
                if (a.at(x, y, 3) > 0) sum += std::abs(a.at(x, y, 0) - b.at(x, y, 0)), ++count;
        return sum / count;
    }
};

}  // namespace

TEST_F(TextureSpace, without_blur_it_is_lambert) {
    const Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    const Image lambert = radiance(renderer, built_in_technique("lambert"), kSmall);
    const Image unblurred = draw(renderer, with({{"blur_passes", "0"}, {"light_map_size", "2048"}}));
    EXPECT_LT(mean_difference(lambert, unblurred), 2e-3);
    const Image blurred =
        draw(renderer, with({{"blur_passes", "8"}, {"blur_bias", "8"}, {"light_map_size", "512"}}));
    EXPECT_GT(mean_difference(lambert, blurred), 1e-2) << "the blur does nothing";
}

TEST_F(TextureSpace, every_filter_keeps_even_light_even_up_to_the_chart_borders) {
    const Scene scene = evenly_lit_spheres();
    Renderer renderer = make_renderer(scene);
    const Image lambert = radiance(renderer, built_in_technique("lambert"), kSmall);
    for (const char* filter : {"poisson", "gaussian", "box", "kawase"}) {
        const Image image =
            draw(renderer, with({{"filter", filter}, {"blur_passes", "4"}, {"blur_bias", "6"}}));
        EXPECT_LT(relative_difference(lambert, image, 1), 1e-3) << filter;
    }
}

TEST_F(TextureSpace, without_dilation_the_gutter_darkens_the_seams) {
    // Proves that the test above can fail.
    Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    const Image good =
        draw(renderer, with({{"dilate", "written_only"}, {"blur_passes", "4"}, {"blur_bias", "20"}}));
    const Image dark = draw(renderer, with({{"dilate", "off"}, {"blur_passes", "4"}, {"blur_bias", "20"}}));
    EXPECT_GT(relative_difference(good, dark, 1), 0.05);
}

TEST_F(TextureSpace, its_coarse_settings_blur_as_widely) {
    const Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    const ParameterValues values = with({{"blur_passes", "8"}, {"blur_bias", "6"}});
    const Technique& technique = built_in_technique("texture_space");
    const Image whole = draw(renderer, values), coarse = draw(renderer, technique.coarse(values, 0.25f)),
                sharp = draw(renderer, with({{"blur_passes", "0"}}));
    EXPECT_LT(mean_difference(whole, coarse), 0.25 * mean_difference(whole, sharp));
}
