// Culling texels of the light map changes no pixel, and does leave texels out.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "image/test_images.h"
#include "render/render_test.h"
#include "support/built_in.h"

using namespace dermis;

namespace {

class AtlasCull : public RenderTest {
  protected:
    using Settings = std::vector<std::pair<const char*, const char*>>;

    static ParameterValues with(const Settings& settings, const char* technique = "texture_space") {
        ParameterValues values(built_in_technique(technique).parameters);
        for (const auto& [name, text] : settings) EXPECT_TRUE(values.set(name, text)) << name;
        return values;
    }
    static uint64_t samples(const gpu::FrameResult& frame, std::string_view pass) {
        const auto found = std::ranges::find(frame.passes, pass, &gpu::PassTiming::name);
        return found == frame.passes.end() ? 0 : found->samples_passed;
    }
    /// Radiance and the texels of the light map that were lit.
    static std::pair<Image, uint64_t> draw(Renderer& renderer, const ParameterValues& values,
                                           const char* technique = "texture_space") {
        const auto frame = renderer.draw(built_in_technique(technique), values,
                                         {.width = 96, .height = 96, .shadow_map_size = 256});
        EXPECT_TRUE(frame) << frame.error().message;
        return {*renderer.radiance(), samples(*frame, "light map")};
    }

    /// To the byte on a CPU; on a GPU some pixels differ by the last place of a half float.
    static void expect_equal(const Image& culled, const Image& whole, const std::string& what) {
        const float most = device().info().is_cpu ? 0 : 0x1p-11f;
        EXPECT_LE(largest_difference(culled, whole), most) << what;
    }

    /// 12 views around the head or every `step`-th of them, each third from nearby; the share of lit texels
    /// that culling keeps, summed.
    static void expect_same_in_12_views(const std::string& name, const Settings& more,
                                        const char* technique = "texture_space", double share = 0.7,
                                        int step = 1) {
        Scene scene = load(name);
        Renderer renderer = make_renderer(scene);
        Settings on = {{"light_map_size", "256"}}, off = on;
        for (const auto& setting : more) on.push_back(setting), off.push_back(setting);
        off.push_back({"cull", "none"});
        const Camera start = scene.camera;
        const float distance_mm = length(start.eye_mm - start.target_mm);
        uint64_t kept = 0, all = 0;
        for (int view = 0; view < 12; view += step) {
            const float yaw_rad = float(view) * std::numbers::pi_v<float> / 6;
            const float pitch_rad = 0.3f * float(view % 3 - 1), near = view % 3 == 0 ? 0.25f : 1.0f;
            scene.camera.eye_mm =
                start.target_mm + direction_from_yaw_pitch(yaw_rad, pitch_rad) * (distance_mm * near);
            fit_depth_range(scene.camera, scene.bounds_center_mm, scene.bounds_radius_mm);
            const auto [culled, lit] = draw(renderer, with(on, technique), technique);
            const auto [whole, lit_whole] = draw(renderer, with(off, technique), technique);
            expect_equal(culled, whole, name + " view " + std::to_string(view));
            EXPECT_GT(lit, lit_whole / 50) << name << " view " << view << ": an empty mask also looks fast";
            EXPECT_LE(lit, lit_whole) << name << " view " << view;
            kept += lit, all += lit_whole;
        }
        EXPECT_LT(double(kept), share * double(all)) << name;
        RecordProperty("kept_" + name + (step == 1 ? "" : "_" + std::to_string(step)),
                       std::to_string(double(kept) / double(all)));
    }
};

}  // namespace

TEST_F(AtlasCull, changes_no_pixel_of_12_views_of_the_bust) {
    expect_same_in_12_views("bust", {});
}

TEST_F(AtlasCull, changes_no_pixel_of_12_views_of_the_head_scan) {
    if (!load_built_in_scene("head_scan"))
        GTEST_SKIP() << "the head scan is not on this machine: tools/get_head";
    expect_same_in_12_views("head_scan", {}, "texture_space", 0.75);
}

TEST_F(AtlasCull, changes_no_pixel_of_12_views_of_the_face) {
    if (!load_built_in_scene("face")) GTEST_SKIP() << "the face is not on this machine";
    expect_same_in_12_views("face", {}, "texture_space", 0.8);
}

TEST_F(AtlasCull, changes_no_pixel_of_6_views_of_heads_under_gaussians) {
    // The face's atlas holds the back of the head too, so its texels are larger and a tile reaches farther.
    for (const auto& [name, share] : std::initializer_list<std::pair<const char*, double>>{
             {"bust", 0.8}, {"head_scan", 0.8}, {"face", 0.85}})
        if (load_built_in_scene(name))
            expect_same_in_12_views(name, {{"light_map_size", "512"}}, "texture_space_gaussians", share, 2);
    expect_same_in_12_views("bust", {{"gaussians", "profile"}}, "texture_space_gaussians", 1, 5);
}

TEST_F(AtlasCull, changes_no_pixel_under_a_wide_blur_with_any_filter) {
    Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    const Settings kinds[] = {{{"blur", "poisson"}, {"blur_radius", "9"}, {"dilate", "off"}},
                              {{"blur", "gaussian"}, {"blur_radius", "9"}, {"dilate", "source"}},
                              {{"blur", "box"}, {"blur_radius", "9"}},
                              {{"blur", "kawase"}, {"blur_passes", "4"}}};
    for (const Settings& kind : kinds) {
        Settings on = {{"light_map_size", "512"}, {"blur_passes", "2"}};
        on.insert(on.end(), kind.begin(), kind.end());
        Settings off = on;
        off.push_back({"cull", "none"});
        const auto [culled, lit] = draw(renderer, with(on));
        const auto [whole, lit_whole] = draw(renderer, with(off));
        expect_equal(culled, whole, kind[0].second);
        EXPECT_LT(lit, lit_whole);
        EXPECT_GT(lit, lit_whole / 3);
    }
}

// From the front, where the backs of the ears face away. In alpha is the kernel's size, 1 where nothing is
// lit.
TEST_F(AtlasCull, the_source_keeps_thin_parts_that_face_away) {
    const Scene scene = load("bust");
    Renderer renderer = make_renderer(scene);
    const auto lit = [&](const char* cull, float from, float to) {
        draw(renderer,
             with({{"preset", "source"}, {"light_map_size", "256"}, {"blur_passes", "0"}, {"cull", cull}}));
        const Image map = to_linear_float(*renderer.read("light_map_a"));
        int count = 0;
        for (int y = 0; y < map.height; ++y)
            for (int x = 0; x < map.width; ++x) count += map.at(x, y, 3) > from && map.at(x, y, 3) < to;
        return count;
    };
    EXPECT_GT(lit("none", 0.26f, 0.999f), 1000);
    EXPECT_EQ(lit("back_face", 0.26f, 0.999f), lit("none", 0.26f, 0.999f));
    EXPECT_LT(lit("back_face", -1, 0.1f), lit("none", -1, 0.1f));
}

TEST_F(AtlasCull, far_away_the_last_light_map_is_used_and_looks_the_same) {
    Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    const Settings size = {{"light_map_size", "256"}};
    Settings keep = size;
    keep.push_back({"cull_beyond_mm", "400"});
    const auto look_from = [&](float yaw_rad, float distance_mm) {
        scene.camera.eye_mm = scene.camera.target_mm + direction_from_yaw_pitch(yaw_rad, 0) * distance_mm;
        fit_depth_range(scene.camera, scene.bounds_center_mm, scene.bounds_radius_mm);
    };
    struct Step {
        float yaw_rad, distance_mm;
        bool lights;
    };
    // Near; far, where the whole map is lit once; around; nearer again; far again.
    const Step steps[] = {{0, 300, true}, {0.5f, 450, true}, {2, 450, false},   {4, 500, false},
                          {4, 300, true}, {5, 450, true},    {5.5f, 450, false}};
    for (const Step& step : steps) {
        look_from(step.yaw_rad, step.distance_mm);
        Renderer fresh = make_renderer(scene);
        const auto [expected, lit] = draw(fresh, with(size));
        const auto [image, lit_now] = draw(renderer, with(keep));
        EXPECT_EQ(image.bytes, expected.bytes) << step.yaw_rad;
        EXPECT_EQ(lit_now > 0, step.lights) << step.yaw_rad;
    }
    scene.lights[0].intensity *= 0.5f;
    EXPECT_GT(draw(renderer, with(keep)).second, 0u) << "another light wants another map";
}
