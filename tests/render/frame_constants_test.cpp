// What a frame tells its shaders by specialisation constants changes what is compiled, not what is drawn.

#include "render/render_test.h"

using namespace dermis;

namespace {

class FrameConstants : public RenderTest {
  protected:
    static inline const DrawSettings kFrame = {
        .width = 96, .height = 96, .shadow_map_size = 512, .penumbra_mm = 12};

    static void SetUpTestSuite() {
        RenderTest::SetUpTestSuite();
        scene_ = std::make_unique<Scene>(load("builtin:bust"));
        bust_ = std::make_unique<Renderer>(make_renderer(*scene_));
    }
    static void TearDownTestSuite() { bust_.reset(); }

    /// Of the bust, with a constant of the list instead of the renderer's.
    static Image drawn_with(Renderer& renderer, std::string_view technique, const std::string& constant,
                            int32_t value) {
        const Technique& found = built_in_technique(technique);
        const ParameterValues values = small_map_values(found);
        EXPECT_TRUE(renderer.draw(found, values, kFrame));
        PassList list = renderer.list();
        std::erase_if(list.constants, [&](const auto& one) { return one.first == constant; });
        list.constants.emplace_back(constant, value);
        EXPECT_TRUE(renderer.executor().run(list, renderer.inputs(values, kFrame)));
        Result<Image> image = renderer.radiance();
        EXPECT_TRUE(image);
        return to_linear_float(*image);
    }

    static float largest_difference(const Image& a, const Image& b) {
        float largest = 0;
        for (int y = 0; y < a.height; ++y)
            for (int x = 0; x < a.width; ++x)
                for (int c = 0; c < 3; ++c)
                    largest = std::max(largest, std::abs(a.at(x, y, c) - b.at(x, y, c)));
        return largest;
    }

    static void expect_same(Renderer& renderer, std::string_view technique, const std::string& constant) {
        const Image on = drawn_with(renderer, technique, constant, 1);
        const Image off = drawn_with(renderer, technique, constant, 0);
        // Rounding moves a tap of 64 of a gathered shadow across an edge: 1 / (64 pi) of white, times the
        // gain.
        EXPECT_LT(largest_difference(on, off), 1.3f * 5e-3f) << technique << ", " << constant;
    }

    static inline std::unique_ptr<Scene> scene_;
    static inline std::unique_ptr<Renderer> bust_;
};

}  // namespace

TEST_F(FrameConstants, one_light_is_the_loop_over_lights_with_one_in_it) {
    for (const char* technique : {"lambert", "preintegrated", "texture_space"})
        expect_same(*bust_, technique, "one_light");
}

TEST_F(FrameConstants, one_sample_is_the_search_for_its_surface) {
    for (const char* technique : {"screen_space_burley", "screen_space_separable"})
        expect_same(*bust_, technique, "one_sample");
}

// It asks the outermost taps for the nearest texel first, and where these agree no others (shadow.glsl): at
// the edge of a shadow that is up to a tap's share of the light.
TEST_F(FrameConstants, a_software_device_draws_the_shadows_of_others_to_a_taps_share) {
    const Image on = drawn_with(*bust_, "lambert", "on_cpu", 1);
    const Image off = drawn_with(*bust_, "lambert", "on_cpu", 0);
    int differing = 0;
    for (int y = 0; y < on.height; ++y)
        for (int x = 0; x < on.width; ++x) differing += std::abs(on.at(x, y, 1) - off.at(x, y, 1)) > 1e-3f;
    EXPECT_LT(differing, on.width * on.height / 200);
    EXPECT_LT(largest_difference(on, off), 0.02f);
}

// The spheres have none.
TEST_F(FrameConstants, a_map_that_no_material_has_is_1) {
    const Scene spheres = load("builtin:spheres");
    Renderer renderer = make_renderer(spheres);
    for (const char* map : {"has_albedo_map", "has_normal_map", "has_specular_map", "has_roughness_map",
                            "has_occlusion_map", "has_emission_map"})
        expect_same(renderer, "lambert", map);
}

TEST_F(FrameConstants, say_which_maps_and_how_many_lights_a_scene_has) {
    Scene scene = *scene_;
    const auto constants_of = [&] {
        Renderer renderer = make_renderer(scene);
        EXPECT_TRUE(renderer.draw(built_in_technique("lambert"),
                                  small_map_values(built_in_technique("lambert")),
                                  {.width = 8, .height = 8, .shadow_map_size = 64}));
        return std::map<std::string, int32_t>(renderer.list().constants.begin(),
                                              renderer.list().constants.end());
    };
    std::map<std::string, int32_t> constants = constants_of();
    EXPECT_EQ(constants.at("has_albedo_map"), 1);
    EXPECT_EQ(constants.at("has_emission_map"), 0);
    EXPECT_EQ(constants.at("one_light"), 1);
    scene.lights.push_back(scene.lights.front());
    EXPECT_EQ(constants_of().at("one_light"), 0);
}
