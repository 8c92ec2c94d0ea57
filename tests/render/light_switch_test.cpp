// A light that is switched: a frame shows nothing of the frames before it.

#include "render/render_test.h"

using namespace dermis;

namespace {

class LightSwitch : public RenderTest {
  protected:
    static inline const DrawSettings kSwitched = {.width = 64, .height = 64, .shadow_map_size = 256};

    static Scene with_light(float on) {
        Scene scene = load("builtin:spheres");
        scene.lights[0].intensity *= on;
        return scene;
    }

    /// On, off and on again: each frame is the one of a renderer whose light never changes.
    void expect_frames_of_steady_light(const Technique& technique, const ParameterValues& values) {
        const Image on = radiance(lit_renderer_, technique, values, kSwitched),
                    off = radiance(dark_renderer_, technique, values, kSwitched);
        EXPECT_NE(on.bytes, off.bytes) << technique.id << ": the light is not seen";
        for (const bool is_on : {true, false, true}) {
            scene_.lights[0].intensity = (is_on ? lit_ : dark_).lights[0].intensity;
            EXPECT_EQ(radiance(renderer_, technique, values, kSwitched).bytes, (is_on ? on : off).bytes)
                << technique.id << (is_on ? " on" : " off");
        }
    }

    const Scene lit_ = with_light(1), dark_ = with_light(0);
    Scene scene_ = lit_;
    Renderer lit_renderer_ = make_renderer(lit_), dark_renderer_ = make_renderer(dark_),
             renderer_ = make_renderer(scene_);
};

}  // namespace

TEST_F(LightSwitch, leaves_nothing_in_the_next_frame_of_any_technique) {
    for (const Technique& technique : built_in_catalog().techniques)
        expect_frames_of_steady_light(technique, small_map_values(technique));
}

// The one that keeps something: a light map, for as long as the light is the same.
TEST_F(LightSwitch, makes_texture_space_light_its_kept_map_again) {
    const Technique& technique = built_in_technique("texture_space");
    ParameterValues values = small_map_values(technique);
    ASSERT_TRUE(values.set("cull_beyond_mm", "1"));
    expect_frames_of_steady_light(technique, values);
}
