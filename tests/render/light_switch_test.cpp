// A light that is switched: a frame shows nothing of the frames before it.

#include "render/render_test.h"

using namespace dermis;

namespace {

class LightSwitch : public RenderTest {
  protected:
    static inline const DrawSettings kSwitched = {.width = 64, .height = 64, .shadow_map_size = 256};

    /// On, off and on again: each frame as a new renderer draws it.
    static void expect_frames_as_new(const Technique& technique, ParameterValues values) {
        if (values.table().find("light_map_size")) EXPECT_TRUE(values.set("light_map_size", "256"));
        Scene scene = load("builtin:spheres");
        const float intensity = scene.lights[0].intensity;
        Renderer renderer = make_renderer(scene);
        std::vector<Image> frames;
        for (const float on : {1.0f, 0.0f, 1.0f}) {
            scene.lights[0].intensity = intensity * on;
            frames.push_back(radiance(renderer, technique, values, kSwitched));
        }
        Renderer fresh = make_renderer(scene);
        EXPECT_EQ(frames[0].bytes, frames[2].bytes) << technique.id;
        EXPECT_EQ(frames[2].bytes, radiance(fresh, technique, values, kSwitched).bytes) << technique.id;
        scene.lights[0].intensity = 0;
        Renderer dark = make_renderer(scene);
        EXPECT_EQ(frames[1].bytes, radiance(dark, technique, values, kSwitched).bytes) << technique.id;
        EXPECT_NE(frames[0].bytes, frames[1].bytes) << technique.id << ": the light is not seen";
    }
};

}  // namespace

TEST_F(LightSwitch, leaves_nothing_in_the_next_frame_of_any_technique) {
    for (const Technique& technique : built_in_catalog().techniques)
        expect_frames_as_new(technique, ParameterValues(technique.parameters));
}

// The one that keeps something: a light map, for as long as the light is the same.
TEST_F(LightSwitch, makes_texture_space_light_its_kept_map_again) {
    const Technique& technique = built_in_technique("texture_space");
    ParameterValues values(technique.parameters);
    ASSERT_TRUE(values.set("cull_beyond_mm", "1"));
    expect_frames_as_new(technique, values);
}
