#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <numbers>

#include "dermis/image/half.h"
#include "dermis/image/io.h"
#include "dermis/scene/cube_map.h"
#include "dermis/scene/environment.h"
#include "dermis/scene/panorama.h"
#include "dermis/scene/prefilter.h"
#include "dermis/scene/scene_files.h"
#include "support/temporary_directory.h"

using namespace dermis;
namespace fs = std::filesystem;

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

template <class Function>
Image panorama_of(int width, const Function& radiance) {
    Image image(width, width / 2, 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < width; ++x) {
            const Vec3 value = radiance(panorama_direction((float(x) + 0.5f) / float(width),
                                                           (float(y) + 0.5f) / float(image.height)));
            image.set(x, y, 0, value.x), image.set(x, y, 1, value.y), image.set(x, y, 2, value.z);
        }
    return image;
}

Image constant_panorama(Vec3 value) {
    return panorama_of(128, [&](Vec3) { return value; });
}

// The texels of one mip of a prefiltered cube.
struct CubeLevel {
    int size;
    const std::byte* bytes;

    CubeLevel(const EnvironmentLight& light, int mip)
        : size(light.base_size >> mip), bytes(light.cube.data() + prefiltered_bytes(light.base_size, mip)) {}
    Vec3 at(int face, int x, int y) const {
        uint16_t rgba[4];
        std::memcpy(rgba, bytes + size_t((face * size + y) * size + x) * sizeof rgba, sizeof rgba);
        return {from_half(rgba[0]), from_half(rgba[1]), from_half(rgba[2])};
    }
    Vec3 direction(int face, int x, int y) const {
        return normalize(
            cube_direction(face, (float(x) + 0.5f) / float(size), (float(y) + 0.5f) / float(size)));
    }
};

Vec3 mean_of_cube(const CubeLevel& level) {
    Vec3 sum;
    float weights = 0;
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < level.size; ++y)
            for (int x = 0; x < level.size; ++x) {
                const Vec3 p = cube_direction(face, (float(x) + 0.5f) / float(level.size),
                                              (float(y) + 0.5f) / float(level.size));
                const float solid_angle = std::pow(dot(p, p), -1.5f);
                sum += level.at(face, x, y) * solid_angle;
                weights += solid_angle;
            }
    return sum * (1 / weights);
}

}  // namespace

TEST(Panorama, directions_and_coordinates_are_inverse_and_the_middle_is_minus_z) {
    const Vec3 middle = panorama_direction(0.5f, 0.5f), right = panorama_direction(0.75f, 0.5f);
    EXPECT_NEAR(middle.z, -1, 1e-6);
    EXPECT_NEAR(right.x, 1, 1e-6);
    EXPECT_NEAR(panorama_direction(0.3f, 0).y, 1, 1e-6);
    for (const Vec2 uv : {Vec2{0.1f, 0.2f}, Vec2{0.9f, 0.7f}, Vec2{0.4f, 0.5f}}) {
        const Vec2 back = panorama_uv(panorama_direction(uv.x, uv.y));
        EXPECT_NEAR(back.x, uv.x, 1e-5);
        EXPECT_NEAR(back.y, uv.y, 1e-5);
    }
}

TEST(Panorama, solid_angles_sum_to_the_sphere) {
    const Image image(64, 32, 3);
    double sum = 0;
    for (int y = 0; y < 32; ++y) sum += 64 * double(panorama_texel_solid_angle(image, y));
    EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-5);
}

TEST(Panorama, cleaning_removes_negative_and_undefined_values_and_averages_down) {
    Image image(8, 4, 3);
    image.set(0, 0, 0, -5), image.set(1, 0, 0, NAN), image.set(0, 1, 0, INFINITY), image.set(1, 1, 0, 4);
    const Image clean = clean_panorama(image, 4);
    ASSERT_EQ(clean.width, 4);
    ASSERT_EQ(clean.height, 2);
    EXPECT_FLOAT_EQ(clean.at(0, 0, 0), (kMaxHalf + 4) / 4);
    EXPECT_EQ(clean.at(1, 0, 0), 0);
}

TEST(CubeMap, faces_and_directions_are_inverse) {
    for (int face = 0; face < 6; ++face)
        for (const float s : {0.1f, 0.5f, 0.8f})
            for (const float t : {0.2f, 0.9f}) {
                const CubePoint point = cube_point(cube_direction(face, s, t));
                EXPECT_EQ(point.face, face);
                EXPECT_NEAR(point.s, s, 1e-6);
                EXPECT_NEAR(point.t, t, 1e-6);
            }
    EXPECT_EQ(cube_point({1, 0, 0}).face, 0);
    EXPECT_EQ(cube_point({0, 0, -1}).face, 5);
}

TEST(CubeMap, lookups_are_continuous_across_edges_at_every_level) {
    const Image image = panorama_of(128, [](Vec3 d) { return Vec3{1 + d.x, 1 + d.y, 1 + d.z}; });
    const CubePyramid cube(image, 32);
    for (const float level : {0.0f, 1.5f, 3.0f})
        for (const float t : {-0.9f, -0.3f, 0.4f, 0.95f}) {
            const Vec3 one = cube.sample({1, t, 0.9999f}, level), other = cube.sample({0.9999f, t, 1}, level);
            EXPECT_LT(length(one - other), 1e-3f) << "level " << level << " t " << t;
        }
}

TEST(SphericalHarmonics, a_constant_environment_has_one_coefficient_and_irradiance_pi) {
    const RadianceSh sh = project_radiance(constant_panorama({1, 2, 0.5f}));
    EXPECT_NEAR(sh[0].x, 2 * std::sqrt(kPi), 1e-3);
    for (size_t i = 1; i < 9; ++i) EXPECT_LT(length(sh[i]), 0.02f) << i;
    const Vec3 e = sh_irradiance(sh, {0, 1, 0});
    EXPECT_NEAR(e.x, kPi, 0.01);
    EXPECT_NEAR(e.y, 2 * kPi, 0.02);
    EXPECT_NEAR(e.z, kPi / 2, 0.005);
}

TEST(SphericalHarmonics, a_linear_lobe_gives_the_analytic_irradiance_along_each_axis) {
    // Radiance 1 + d.a has irradiance pi + (2 pi / 3) n.a: only bands 0 and 1, so order 2 is exact.
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        const Image image = panorama_of(128, [&](Vec3 d) { return Vec3{1, 1, 1} * (1 + dot(d, axis)); });
        const RadianceSh sh = project_radiance(image);
        EXPECT_NEAR(sh_irradiance(sh, axis).x, kPi + 2 * kPi / 3, 2e-3);
        EXPECT_NEAR(sh_irradiance(sh, -axis).x, kPi - 2 * kPi / 3, 2e-3);
    }
}

TEST(SphericalHarmonics, each_basis_function_projects_onto_its_own_coefficient) {
    for (size_t i = 0; i < 9; ++i) {
        const Image image = panorama_of(128, [&](Vec3 d) { return Vec3{1, 1, 1} * sh_basis(d)[i]; });
        const RadianceSh sh = project_radiance(image);
        for (size_t j = 0; j < 9; ++j) EXPECT_NEAR(sh[j].x, i == j ? 1 : 0, 2e-3) << i << " " << j;
    }
}

TEST(SphericalHarmonics, a_cosine_lobe_of_radiance_is_within_three_percent_of_the_analytic_irradiance) {
    // Radiance max(0, d.a), surface facing a: the integral of cos^2 over the hemisphere is 2 pi / 3.
    const Vec3 axis = normalize(Vec3{1, 2, -1});
    const Image image = panorama_of(256, [&](Vec3 d) {
        return Vec3{1, 1, 1} * std::max(dot(d, axis), 0.0f);
    });
    EXPECT_NEAR(sh_irradiance(project_radiance(image), axis).x, 2 * kPi / 3, 0.03 * 2 * kPi / 3);
}

TEST(Prefilter, a_constant_environment_stays_constant_at_every_roughness) {
    const EnvironmentLight light = bake_environment(constant_panorama({0.5f, 1, 2}), 16, 4);
    for (int mip = 0; mip < 4; ++mip) {
        const CubeLevel level(light, mip);
        for (int face = 0; face < 6; ++face)
            for (int y = 0; y < level.size; ++y)
                for (int x = 0; x < level.size; ++x) {
                    const Vec3 c = level.at(face, x, y);
                    ASSERT_NEAR(c.x, 0.5, 1e-3) << mip;
                    ASSERT_NEAR(c.z, 2, 4e-3) << mip;
                }
    }
}

TEST(Prefilter, the_mirror_level_is_the_environment_and_rough_levels_keep_its_mean) {
    const Image image = panorama_of(256, [](Vec3 d) {
        return Vec3{1 + d.x, 1 + d.y, dot(d, normalize(Vec3{1, 1, 1})) > 0.9f ? 10.0f : 0.2f};
    });
    const EnvironmentLight light = bake_environment(image, 32, 4);
    const CubeLevel mirror(light, 0);
    for (int face = 0; face < 6; ++face) {
        const Vec3 d = mirror.direction(face, 20, 9);
        EXPECT_NEAR(mirror.at(face, 20, 9).x, 1 + d.x, 0.02);
        EXPECT_NEAR(mirror.at(face, 20, 9).y, 1 + d.y, 0.02);
    }
    const Vec3 mean = mean_of_cube(mirror);
    for (int mip = 1; mip < 4; ++mip) {
        const Vec3 here = mean_of_cube(CubeLevel(light, mip));
        EXPECT_NEAR(here.x, mean.x, 0.02 * mean.x) << mip;
        EXPECT_NEAR(here.z, mean.z, 0.02 * mean.z) << mip;
    }
}

TEST(Prefilter, agrees_with_brute_force_integration_of_the_lobe) {
    const Vec3 axis = normalize(Vec3{0.3f, 0.5f, 0.8f});
    const auto radiance = [&](Vec3 d) { return std::pow(std::max(dot(d, axis), 0.0f), 8.0f) * 5 + 0.1f; };
    const Image image = panorama_of(256, [&](Vec3 d) { return Vec3{1, 1, 1} * radiance(d); });
    const EnvironmentLight light = bake_environment(image, 32, 4);
    for (int mip = 1; mip < 4; ++mip) {
        const CubeLevel level(light, mip);
        const float alpha = std::pow(float(mip) / 3, 2.0f), a2 = alpha * alpha;
        const Vec3 n = level.direction(4, level.size / 2, level.size / 3);
        double sum = 0, weights = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const Vec3 l = panorama_direction((float(x) + 0.5f) / 256, (float(y) + 0.5f) / 128);
                const float nl = dot(n, l);
                if (nl <= 0) continue;
                const float nh = dot(n, normalize(n + l)), d = nh * nh * (a2 - 1) + 1;
                const double weight = double(a2 / (d * d) * nl * panorama_texel_solid_angle(image, y));
                sum += weight * double(radiance(l));
                weights += weight;
            }
        const float expected = float(sum / weights);
        EXPECT_NEAR(level.at(4, level.size / 2, level.size / 3).x, expected, 0.02f * expected + 0.01f) << mip;
    }
}

TEST(Environment, yaw_turns_what_is_in_front_towards_plus_x) {
    // After a quarter turn, +Z of the environment appears at +X of the world.
    const Vec3 d = to_environment({1, 0, 0}, kPi / 2);
    EXPECT_NEAR(d.z, 1, 1e-6);
    EXPECT_NEAR(d.x, 0, 1e-6);
}

TEST(Environment, none_is_black_and_the_studio_lights_from_the_key_side) {
    const Result<EnvironmentLight> none = prepare_environment({.kind = EnvironmentKind::none});
    ASSERT_TRUE(none);
    EXPECT_EQ(length(none->radiance_sh[0]), 0);
    EXPECT_EQ(none->cube.size(), prefiltered_bytes(none->base_size, none->mips));
    const RadianceSh sh = project_radiance(make_studio_panorama(128));
    const Vec3 key = direction_from_yaw_pitch(-50 * kPi / 180, 35 * kPi / 180);
    const float lit = sh_irradiance(sh, key).y, away = sh_irradiance(sh, {-key.x, key.y, key.z}).y;
    EXPECT_GT(lit, 1.3f * away);
    EXPECT_GT(away, 0.2f * lit);
}

TEST(Environment, a_file_is_cached_by_content_and_read_back_the_same) {
    const TemporaryDirectory dir;
    ::setenv("DERMIS_CACHE", (dir.path / "cache").c_str(), 1);
    const fs::path file = dir.path / "sky.exr";
    ASSERT_TRUE(write_image(file, panorama_of(64, [](Vec3 d) { return Vec3{1 + d.y, 1, 1 - d.y}; })));
    const Environment environment{.kind = EnvironmentKind::file, .file = file};
    const Result<EnvironmentLight> cold = prepare_environment(environment);
    ASSERT_TRUE(cold) << cold.error().message;
    const auto entries = [&] {
        return std::distance(fs::directory_iterator(dir.path / "cache" / "environment"), {});
    };
    EXPECT_EQ(entries(), 1);
    const Result<EnvironmentLight> warm = prepare_environment(environment);
    ASSERT_TRUE(warm);
    EXPECT_EQ(cold->cube, warm->cube);
    EXPECT_EQ(cold->radiance_sh, warm->radiance_sh);
    ASSERT_TRUE(write_image(file, constant_panorama({1, 1, 1})));
    ASSERT_TRUE(prepare_environment(environment));
    EXPECT_EQ(entries(), 2);
    ::unsetenv("DERMIS_CACHE");
}

TEST(Environment, a_file_that_is_no_panorama_is_an_error_that_says_so) {
    const TemporaryDirectory dir;
    const fs::path file = dir.path / "square.exr";
    ASSERT_TRUE(write_image(file, Image(16, 16, 3)));
    const Environment environment{.kind = EnvironmentKind::file, .file = file};
    EXPECT_EQ(prepare_environment(environment).error().message,
              file.string() + ": 16 x 16 texels; a latitude-longitude panorama is twice as wide as high");
}

TEST(Environment, the_test_panoramas_have_finite_light_whatever_their_files_hold) {
    for (const char* name : {"studio.hdr", "sunset.hdr", "apartment.hdr", "courtyard.exr"}) {
        const Result<fs::path> file = resolve_path(std::string("assets:hdri/") + name, "");
        if (!file) GTEST_SKIP() << file.error().message;
        const Result<Image> panorama = load_panorama({.kind = EnvironmentKind::file, .file = *file});
        ASSERT_TRUE(panorama) << panorama.error().message;
        for (const float value : panorama->floats()) ASSERT_TRUE(value >= 0 && value <= kMaxHalf);
        const RadianceSh sh = project_radiance(*panorama);
        EXPECT_GT(sh[0].y, 0.01f) << name;
    }
}
