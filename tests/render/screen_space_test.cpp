// Blurs on the picture: the faults that users of other engines report. Every scene has a known answer.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/shadowed_plane.h"

using namespace dermis;

namespace {

constexpr const char* kTechniques[] = {"screen_space_separable", "screen_space_burley"};
constexpr int kPictureSize = 96;
constexpr float kHalfHeightMm = 9;  // of the slanted plane's picture

using Settings = std::vector<std::pair<std::string, std::string>>;

struct ScreenBlur {
    const char *technique, *parameter, *value;
};
constexpr ScreenBlur kBlurs[] = {{"screen_space_separable", "kernel", "profile"},
                                 {"screen_space_separable", "kernel", "artistic"},
                                 {"screen_space_burley", "rotate", "on"}};

Settings settings_of(const ScreenBlur& blur) {
    return {{blur.parameter, blur.value}};
}

class ScreenSpace : public RenderTest {
  protected:
    static Image draw(const Scene& scene, const std::string& id, const Settings& settings = {},
                      int samples = 1) {
        Renderer renderer = make_renderer(scene);
        return draw(renderer, id, settings, samples);
    }
    static Image draw(Renderer& renderer, const std::string& id, const Settings& settings = {},
                      int samples = 1) {
        const Technique& technique = built_in_technique(id);
        ParameterValues values = without_gain(ParameterValues(technique.parameters));
        for (const auto& [name, text] : settings) EXPECT_TRUE(values.set(name, text)) << name;
        return radiance(renderer, technique, values,
                        {.width = kPictureSize,
                         .height = kPictureSize,
                         .samples = samples,
                         .view = "diffuse",
                         .deep = true,
                         .shadow_map_size = 1024,
                         .penumbra_mm = 0.05f});
    }
    // The plane of shadowed_plane.h from the left, so that the slope is across its shadow's edge.
    static Scene slanted_plane(float distance_mm) {
        Scene scene = half_shadowed(plane(one_chart));
        scene.camera.eye_mm = Vec3{-0.8f, 0, 0.6f} * distance_mm;
        scene.camera.vertical_fov_rad = 2 * std::atan(kHalfHeightMm / distance_mm);
        fit_depth_range(scene.camera, scene.bounds_center_mm, scene.bounds_radius_mm);
        return scene;
    }
    // Largest difference from the profile's own edge along the middle row, for a camera as above.
    static double edge_error(const Image& image, float distance_mm) {
        const GaussianSum skin = gpu_gems_3_skin();
        double largest = 0;
        for (int i = 0; i < kPictureSize; ++i) {
            // Forward (.8, 0, -.6), right (.6, 0, .8): where the pixel's ray meets z = 0.
            const double t = kHalfHeightMm / distance_mm * (2 * (i + 0.5) / kPictureSize - 1);
            const double dx = 0.8 + 0.6 * t, dz = -0.6 + 0.8 * t;
            const double x_mm = -0.8 * distance_mm - 0.6 * distance_mm * dx / dz;
            // Not at the pixels of the edge, which are narrower than one; nor where the profile reaches out
            // of the picture.
            const double from_edge_mm = std::abs(x_mm - kEdgeMm);
            if (from_edge_mm < 0.5 || from_edge_mm > 4) continue;
            for (int c = 0; c < 3; ++c) {
                double lit = 0;
                for (const GaussianTerm& term : skin.terms)
                    lit += term.weight[size_t(c)] / 2 *
                           (1 + std::erf((kEdgeMm - x_mm) / std::sqrt(2 * term.variance_mm2)));
                const double seen =
                    (image.at(i, kPictureSize / 2, c) + image.at(i, kPictureSize / 2 - 1, c)) / 2;
                largest = std::max(largest, std::abs(seen * std::numbers::pi - lit));
            }
        }
        return largest;
    }
};

}  // namespace

TEST_F(ScreenSpace, a_shadows_edge_is_the_profiles_at_any_distance_and_slant) {
    for (const float distance_mm : {60.0f, 240.0f}) {
        const Scene scene = slanted_plane(distance_mm);
        Renderer renderer = make_renderer(scene);
        const auto separable = [&](const char* taps) {
            return edge_error(draw(renderer, "screen_space_separable", {{"taps", taps}}), distance_mm);
        };
        EXPECT_LT(separable("25"), 0.03);
        EXPECT_LT(separable("17"), 0.05);
        EXPECT_LT(separable("11"), 0.08);
        // Its weights fit surfaces whose slope changes, such as spheres, better than planes.
        EXPECT_LT(edge_error(draw(renderer, "screen_space_burley", {{"samples", "512"}}), distance_mm),
                  0.045);
    }
    // Distances on the picture's plane are too short here.
    EXPECT_GT(edge_error(draw(slanted_plane(60), "screen_space_separable", {{"follow", "none"}}), 60), 0.05);
}

TEST_F(ScreenSpace, light_does_not_cross_a_gap_in_depth) {
    for (const ScreenBlur& blur : kBlurs) {
        const char* id = blur.technique;
        const Image image = draw(two_walls(), id, settings_of(blur));
        size_t lit = 0, dark = 0;
        for (int x = 0; x < kPictureSize; ++x) {
            const float red = image.at(x, kPictureSize / 2, 0) * std::numbers::pi_v<float>;
            lit += std::abs(red - 1) < 2e-3, dark += red < 2e-3;
        }
        EXPECT_GE(lit + dark, size_t(kPictureSize) - 4)
            << id << ": all but two pixels on each side of the gap";
        EXPECT_GT(lit, 40u) << id;
        EXPECT_GT(dark, 40u) << id;
    }
    const Image bled = draw(two_walls(), "screen_space_separable", {{"follow", "none"}});
    EXPECT_GT(bled.at(kPictureSize / 2 + 3, kPictureSize / 2, 0), 0.02) << "the scene would not show it";
}

TEST_F(ScreenSpace, constant_light_stays_constant_at_silhouettes_with_and_without_multisampling) {
    const Scene scene = evenly_lit_spheres();
    Renderer renderer = make_renderer(scene);
    for (const int samples : {1, 4}) {
        const Image lambert = draw(renderer, "lambert", {}, samples);
        for (const ScreenBlur& blur : kBlurs) {
            const Image blurred = draw(renderer, blur.technique, settings_of(blur), samples);
            EXPECT_LT(relative_difference(lambert, blurred, 1), 1e-3)
                << blur.technique << " " << blur.value << ", samples " << samples;
        }
    }
}

TEST_F(ScreenSpace, a_light_that_goes_out_leaves_nothing_behind) {
    const Scene lit = half_shadowed(plane(one_chart));
    Scene dark = lit;
    dark.lights[0].intensity = 0;
    for (const char* id : kTechniques) {
        Renderer renderer = make_renderer(lit);
        const Technique& technique = built_in_technique(id);
        const DrawSettings settings = {.width = kPictureSize, .height = kPictureSize, .view = "diffuse"};
        EXPECT_GT(radiance(renderer, technique, settings).at(10, kPictureSize / 2, 0), 0.1f) << id;
        Renderer dark_renderer = make_renderer(dark);
        EXPECT_EQ(radiance(dark_renderer, technique, settings).at(10, kPictureSize / 2, 0), 0.0f) << id;
    }
}
