// A character as people have them: many materials, no maps of colour.

#include <algorithm>
#include <filesystem>

#include "mesh/mesh_files.h"
#include "render/render_test.h"

using namespace dermis;

namespace {

class OwnHead : public RenderTest {
  protected:
    // The light of every technique on ICT's face.
    void for_each_light(const DrawSettings& settings, const auto& check) {
        const std::filesystem::path file = test::asset("ict_face/ict_moving.glb");
        if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is needed";
        const Scene scene = load(file.string());
        Renderer renderer = make_renderer(scene);
        for (const Technique& technique : built_in_catalog().techniques) {
            SCOPED_TRACE(technique.id);
            check(radiance(renderer, technique, ParameterValues(technique.parameters), settings));
        }
    }
};

// Skin's base colour has more red than green; eyes and teeth have as much blue as green.
std::string greener_than_red(const Image& light) {
    constexpr float kRelative = 0.01f, kLeast = 0.03f, kLeastOverBlue = 0.01f;
    std::string places;
    for (int y = 0; y < light.height; ++y)
        for (int x = 0; x < light.width; ++x) {
            const float r = light.at(x, y, 0), g = light.at(x, y, 1), b = light.at(x, y, 2);
            if (light.at(x, y, 3) > 0 && g > kLeast && g - b > kLeastOverBlue && g > (1 + kRelative) * r)
                places += " " + std::to_string(x) + "," + std::to_string(y);
        }
    return places;
}

}  // namespace

// Red scatters farthest: in folds and at edges of shadows a technique can take more of it away than walks do.
TEST_F(OwnHead, no_skin_is_greener_than_red) {
    for_each_light({.width = 768, .height = 768},
                   [](const Image& light) { EXPECT_EQ(greener_than_red(light), ""); });
}

// At samples of an edge what vertices carry is not continued beyond the triangle.
TEST_F(OwnHead, no_light_is_below_zero_with_four_samples_a_pixel) {
    for_each_light({.width = 384, .height = 384, .samples = 4}, [](const Image& light) {
        float least = 0;
        for (int y = 0; y < light.height; ++y)
            for (int x = 0; x < light.width; ++x)
                for (int c = 0; c < 3; ++c) least = std::min(least, light.at(x, y, c));
        EXPECT_EQ(least, 0);
    });
}
