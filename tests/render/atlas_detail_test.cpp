// detail=pixel: what the light map's texels cannot hold is damped by the profile, not kept whole.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "render/shadowed_plane.h"
#include "support/built_in.h"

using namespace dermis;

namespace {

constexpr int kMapSize = 64, kPicture = 96;
constexpr double kTexelMm = double(kSideMm) / (0.8 * kMapSize);  // .78
constexpr double kWaveMm = 1.2, kSeenMm = 12;

// Normals of the plane that lean along x by a wave shorter than two texels of the light map.
ImageSource normal_wave() {
    constexpr int kSize = 1024;
    std::vector<std::byte> pixels;
    const auto encoded = [](double v) { return std::byte(std::lround((v * 0.5 + 0.5) * 255)); };
    for (int i = 0; i < kSize * kSize; ++i) {
        const double x_mm = (double(i % kSize) + 0.5) / kSize * double(kSideMm) / 0.8;
        const double lean = 0.2 * std::sin(2 * std::numbers::pi * x_mm / kWaveMm);
        for (const double v : {lean, 0.0, std::sqrt(1 - lean * lean)}) pixels.push_back(encoded(v));
    }
    return {.name = "wave", .width = kSize, .height = kSize, .channels = 3, .pixels = std::move(pixels)};
}

Scene waves() {
    Scene scene = half_shadowed(plane(one_chart));
    scene.objects.resize(1);
    scene.objects[0].mesh.materials[0].normal_map = normal_wave();
    scene.lights = {{.name = "key", .to_light_world = {0.6f, 0, 0.8f}, .casts_shadow = false}};
    scene.camera = {.eye_mm = {0, 0, 1000}, .vertical_fov_rad = 2 * std::atan(float(kSeenMm) / 2 / 1000)};
    fit_depth_range(scene.camera, scene.bounds_center_mm, scene.bounds_radius_mm);
    return scene;
}

double height_of_wave(const Image& image, int channel) {
    std::complex<double> sum = 0;
    for (int y = 0; y < kPicture; ++y)
        for (int x = 0; x < kPicture; ++x)
            sum += double(image.at(x, y, channel)) *
                   std::polar(1.0, -2 * std::numbers::pi * (x + 0.5) * kSeenMm / kPicture / kWaveMm);
    return std::abs(sum) / (kPicture * kPicture);
}

double kept_by_skin(double wave_mm, int channel) {
    const Vec3 kept =
        profile_transfer(gpu_gems_3_skin(), 2 * std::numbers::pi * std::numbers::pi / (wave_mm * wave_mm));
    return double(channel == 0 ? kept.x : channel == 1 ? kept.y : kept.z);
}

class AtlasDetail : public RenderTest {
  protected:
    static Image draw(const char* technique,
                      std::initializer_list<std::pair<const char*, const char*>> more) {
        const Scene scene = waves();
        Renderer renderer = make_renderer(scene);
        const Technique& found = built_in_technique(technique);
        ParameterValues values(found.parameters);
        for (const auto& [name, text] : more) EXPECT_TRUE(values.set(name, text)) << name;
        return radiance(renderer, found, values,
                        {.width = kPicture, .height = kPicture, .view = "diffuse", .deep = true});
    }
};

}  // namespace

TEST_F(AtlasDetail, waves_of_normals_below_a_texel_are_damped_as_the_profile_damps_them) {
    ASSERT_LT(kWaveMm, 2 * kTexelMm);
    const Image lambert = draw("lambert", {});
    for (const char* technique : {"texture_space", "texture_space_gaussians"}) {
        const Image skin = draw(technique, {{"light_map_size", "64"}});
        for (int c = 0; c < 3; ++c) {
            const double kept = height_of_wave(skin, c) / height_of_wave(lambert, c);
            EXPECT_GT(kept, kept_by_skin(kWaveMm, c) - 0.08) << technique << ", channel " << c;
            EXPECT_LT(kept, kept_by_skin(2.5 * kTexelMm, c) + 0.02) << technique << ", channel " << c;
        }
    }
}

TEST_F(AtlasDetail, a_blur_without_width_is_lambert_below_a_texel_too) {
    const Image lambert = draw("lambert", {});
    const Image gaussians = draw("texture_space_gaussians", {{"light_map_size", "64"}, {"width", "0"}});
    EXPECT_LT(relative_difference(lambert, gaussians, 1), 1e-3);
    const Image no_passes = draw("texture_space", {{"light_map_size", "64"}, {"blur_passes", "0"}});
    EXPECT_LT(relative_difference(lambert, no_passes, 1), 1e-3);
}
