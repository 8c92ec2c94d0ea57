// Blurs over the atlas in millimetres: the UV layout must not matter.

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/mesh/uv_seams.h"
#include "render/shadowed_plane.h"
#include "support/built_in.h"

using namespace dermis;

namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

struct Blur {
    const char* technique;
    Settings settings;
};

const std::vector<Blur>& blurs_in_mm() {
    static const std::vector<Blur> kBlurs = {
        {"texture_space", {{"light_map_size", "512"}}},
        {"texture_space_gaussians", {{"detail", "map"}, {"light_map_size", "512"}}}};
    return kBlurs;
}

class AtlasMm : public RenderTest {
  protected:
    static ParameterValues with(const Blur& blur, const Settings& more = {}) {
        ParameterValues values = without_gain(ParameterValues(built_in_technique(blur.technique).parameters));
        for (const auto& [name, text] : blur.settings) EXPECT_TRUE(values.set(name, text)) << name;
        for (const auto& [name, text] : more) EXPECT_TRUE(values.set(name, text)) << name;
        return values;
    }
    static Image draw(const Scene& scene, const Blur& blur, const Settings& more = {}, float scale = 1) {
        Renderer renderer = make_renderer(scene);
        return radiance(renderer, built_in_technique(blur.technique), with(blur, more),
                        {.width = 96,
                         .height = 96,
                         .view = "light_map",
                         .deep = true,
                         .shadow_map_size = 1024,
                         .penumbra_mm = 0.05f * scale});
    }
    /// Largest difference of any channel over the pixels that both cover.
    static double largest_difference(const Image& a, const Image& b) {
        double largest = 0;
        size_t count = 0;
        for (int y = 0; y < a.height; ++y)
            for (int x = 0; x < a.width; ++x) {
                if (a.at(x, y, 3) < 1 || b.at(x, y, 3) < 1) continue;
                ++count;
                for (int c = 0; c < 3; ++c)
                    largest = std::max(largest, std::abs(double(a.at(x, y, c)) - b.at(x, y, c)));
            }
        EXPECT_GT(count, 4000u);
        return largest * 3.14159265;
    }
};

}  // namespace

TEST_F(AtlasMm, the_uv_layout_does_not_matter) {
    for (const Blur& blur : blurs_in_mm()) {
        const Image plain = draw(half_shadowed(plane(one_chart)), blur);
        EXPECT_LT(largest_difference(plain, draw(half_shadowed(plane(stretched)), blur)), 0.06)
            << blur.technique;
        EXPECT_LT(largest_difference(plain, draw(half_shadowed(plane(sheared)), blur)), 0.06)
            << blur.technique;
    }
    // In texels it does.
    const Blur texels = {"texture_space",
                         {{"blur", "gaussian"}, {"blur_radius", "20"}, {"light_map_size", "512"}}};
    EXPECT_GT(largest_difference(draw(half_shadowed(plane(one_chart)), texels),
                                 draw(half_shadowed(plane(sheared)), texels)),
              0.06);
}

TEST_F(AtlasMm, a_seam_a_millimetre_from_the_shadow_is_not_visible) {
    const Scene cut = half_shadowed(plane(two_charts));
    for (const Blur& blur : blurs_in_mm()) {
        const Image whole = draw(half_shadowed(plane(one_chart)), blur);
        EXPECT_LT(largest_difference(whole, draw(cut, blur)), 0.05) << blur.technique;
    }
    const Blur& gaussians = blurs_in_mm()[1];
    EXPECT_GT(largest_difference(draw(half_shadowed(plane(one_chart)), gaussians),
                                 draw(cut, gaussians, {{"carry_seams", "off"}})),
              0.08);
}

// Looked at from the side where its chart begins and ends, lit so that the terminator lies there.
TEST_F(AtlasMm, a_sphere_shows_no_seam_at_the_terminator) {
    Scene scene = load("builtin:unit");
    scene.camera.eye_mm.z = -scene.camera.eye_mm.z;
    scene.lights[0].to_light_world = direction_from_yaw_pitch(1.75f, 0);
    const auto step = [&](const Blur& blur, const Settings& more) {
        Settings settings = {{"transmission", "none"}};
        settings.insert(settings.end(), more.begin(), more.end());
        const Image image = draw(scene, blur, settings);
        double largest = 0;
        for (int y = 30; y < 66; ++y)
            largest = std::max(largest, double(std::abs(image.at(47, y, 0) - image.at(48, y, 0))));
        return largest * 3.14159265;
    };
    const double dropped = step(blurs_in_mm()[1], {{"carry_seams", "off"}});
    for (const Blur& blur : blurs_in_mm()) EXPECT_LT(step(blur, {}), 0.5 * dropped) << blur.technique;
}

TEST_F(AtlasMm, twice_the_scene_with_twice_the_millimetres_is_the_same_picture) {
    const Blur& blur = blurs_in_mm()[1];
    const Image once = draw(half_shadowed(plane(sheared)), blur),
                twice = draw(half_shadowed(plane(sheared), 2), blur, {{"width", "2"}}, 2);
    EXPECT_LT(largest_difference(once, twice), 2e-3);
    EXPECT_GT(largest_difference(once, draw(half_shadowed(plane(sheared), 2), blur, {}, 2)), 0.05);
}

TEST_F(AtlasMm, constant_light_stays_constant_up_to_the_chart_borders) {
    const Scene scene = evenly_lit_spheres();
    Renderer renderer = make_renderer(scene);
    const DrawSettings diffuse = {.width = 128, .height = 128, .view = "diffuse", .shadow_map_size = 256};
    const Image lambert = radiance(renderer, built_in_technique("lambert"), diffuse);
    for (const Blur& blur : blurs_in_mm()) {
        const Image image = radiance(renderer, built_in_technique(blur.technique), with(blur), diffuse);
        EXPECT_LT(relative_difference(lambert, image, 1), 1e-3) << blur.technique;
    }
}

TEST(SeamMap, unfolds_the_neighbour_over_the_shared_edge) {
    const Mesh mesh = plane(two_charts);
    const AtlasPart part = {.mesh = &mesh, .triangles = {0, 1, 2, 3}};
    const SeamMap map = make_seam_map(std::span(&part, 1), 256, 12);
    size_t carried = 0;
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x) {
            const Vec2 to = map.carried[size_t(y * 256 + x)];
            if (to.x < 0) continue;
            ++carried;
            // Back through the UV layout of the chart whose gutter it is, and of the one that it shows.
            const Vec2 uv = {(float(x) + 0.5f) / 256, (float(y) + 0.5f) / 256};
            const Vec2 left_mm = {(uv.x - 0.45f) * kSideMm / 0.8f, (0.5f - uv.y) * kSideMm / 0.8f};
            const Vec2 right_mm = {(to.y / 256 - 0.1f) * kSideMm / 1.1f,
                                   (to.x / 256 - 0.75f) * kSideMm / 0.44f};
            if (map.chart[size_t(y * 256 + x)] != 1) continue;
            EXPECT_NEAR(left_mm.x, right_mm.x, 1e-3);
            EXPECT_NEAR(left_mm.y, right_mm.y, 1e-3);
        }
    EXPECT_GT(carried, 1500u);
}
