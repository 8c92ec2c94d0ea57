// accumulate=frames against pictures with many samples: still, with a camera that moves, with light that
// changes.

#include <gtest/gtest.h>

#include "render/shadowed_plane.h"
#include "techniques/screen_space_burley/constants.h"
#include "techniques/screen_space_burley/test_pictures.h"

using namespace dermis;
using namespace dermis::screen_space_burley;

namespace {

class BurleyAccumulation : public ScreenSpaceBurleyTest {
  protected:
    static inline const Settings kFew = {{"samples", "8"}};
    static inline const Settings kOverFrames = {{"samples", "8"}, {"accumulate", "frames"}};
    // Still; at 8 frames the spirals are not as even together as one of 64 samples.
    static constexpr double kBehindDb = 3;
    static inline const Settings kMany = {{"samples", "2048"}};

    static Scene dark_background(const std::string& name) {
        Scene scene = load(name);
        scene.background_linear = {};
        scene.environment.visible = false;
        return scene;
    }
    static Vec3 turned(Vec3 v, float angle_rad) {
        const float c = std::cos(angle_rad), s = std::sin(angle_rad);
        return {c * v.x + s * v.z, v.y, c * v.z - s * v.x};
    }
    static void turn_camera(Scene& scene, float angle_rad) {
        Camera& camera = scene.camera;
        camera.eye_mm = camera.target_mm + turned(camera.eye_mm - camera.target_mm, angle_rad);
    }
    // Largest difference of red.
    static double largest(const Image& a, const Image& b) {
        double most = 0;
        for (size_t i = 0; i < a.pixel_count(); ++i)
            most = std::max(most, std::abs(double(a.floats()[4 * i]) - double(b.floats()[4 * i])));
        return most;
    }
};

}  // namespace

TEST_F(BurleyAccumulation, the_first_frame_is_that_without) {
    const Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    const Image without = draw(renderer, kFew);
    EXPECT_EQ(draw(renderer, kOverFrames).bytes, without.bytes);
    EXPECT_NE(draw(renderer, kOverFrames).bytes, without.bytes) << "the second";
    renderer.forget_history();
    EXPECT_EQ(draw(renderer, kOverFrames).bytes, without.bytes);
}

TEST_F(BurleyAccumulation, frames_of_a_still_scene_are_as_more_samples) {
    const Scene scene = dark_background("builtin:spheres");
    Renderer renderer = make_renderer(scene), other = make_renderer(scene);
    const Image many = draw(other, kMany);
    for (int frames = 1; frames <= kMostFrames; ++frames) {
        const double db = psnr_db(draw(renderer, kOverFrames), many);
        EXPECT_EQ(renderer.is_settled(), frames == kMostFrames);
        RecordProperty("psnr_db_" + std::to_string(frames), std::to_string(db));
        if (frames == 1 || frames == 2 || frames == 4 || frames == 8) {
            const Settings as_many = {{"samples", std::to_string(8 * frames)}};
            EXPECT_GT(db, psnr_db(draw(other, as_many), many) - kBehindDb) << frames;
        }
        if (frames == kMostFrames) EXPECT_GT(db, 65);
    }
}

// Nearer than a single frame of as many samples at every speed: what lags is less than the noise that is
// gone.
TEST_F(BurleyAccumulation, is_nearer_while_camera_or_light_move) {
    for (const char* name : {"builtin:spheres", "builtin:bust"})
        for (const float step_rad : {0.003f, 0.03f}) {
            Scene scene = dark_background(name);
            Renderer renderer = make_renderer(scene), other = make_renderer(scene);
            for (int i = 0; i < 12; ++i) {
                scene.lights[0].to_light_world = turned(scene.lights[0].to_light_world, step_rad);
                draw(renderer, kOverFrames);
            }
            const Image many = draw(other, kMany);
            EXPECT_GT(psnr_db(draw(renderer, kOverFrames), many), psnr_db(draw(other, kFew), many) + 1)
                << name << ", light, " << step_rad;
        }
    Scene scene = dark_background("builtin:spheres");
    Renderer renderer = make_renderer(scene), other = make_renderer(scene);
    for (int i = 0; i < 12; ++i) {
        turn_camera(scene, 0.02f);
        draw(renderer, kOverFrames);
    }
    turn_camera(scene, 0.02f);
    const Image many = draw(other, kMany);
    EXPECT_GT(psnr_db(draw(renderer, kOverFrames), many), psnr_db(draw(other, kFew), many) + 4) << "camera";
}

// The camera comes to see 2 mm of a dark wall that a lit one hid. 16 of 96 pixels show the lit one in the
// frame before.
TEST_F(BurleyAccumulation, a_moved_silhouette_leaves_nothing) {
    Scene scene = two_walls();
    scene.camera.eye_mm.x = -10;
    Renderer renderer = make_renderer(scene), other = make_renderer(scene);
    for (int i = 0; i < 8; ++i) draw(renderer, kOverFrames);
    scene.camera.eye_mm.x = 0;
    EXPECT_LT(largest(draw(renderer, kOverFrames), draw(other, kFew)), 0.02);
}

TEST_F(BurleyAccumulation, a_light_that_goes_out_is_gone_in_the_first_frame) {
    for (const char* name : {"builtin:spheres", "builtin:bust"}) {
        Scene scene = dark_background(name);
        const float intensity = scene.lights[0].intensity;
        Renderer renderer = make_renderer(scene), other = make_renderer(scene);
        const Image lit = draw(other, kMany);
        scene.lights[0].intensity = 0;
        const Image dark = draw(other, kMany);
        scene.lights[0].intensity = intensity;
        for (int i = 0; i < 8; ++i) draw(renderer, kOverFrames);
        scene.lights[0].intensity = 0;
        EXPECT_LT(largest(draw(renderer, kOverFrames), dark), 0.03 * largest(lit, dark)) << name;
        for (int i = 0; i < 3; ++i) draw(renderer, kOverFrames);
        EXPECT_LT(largest(draw(renderer, kOverFrames), dark), 0.015 * largest(lit, dark)) << name;
    }
}
