#include "dermis/reference/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "dermis/base/parallel.h"
#include "dermis/image/io.h"
#include "dermis/optics/fresnel.h"
#include "reference/shapes.h"

namespace dermis {
namespace {

constexpr float kPi = 3.14159265f;

// A white sphere of 20 mm that fills the picture's middle, one directional light of irradiance pi.
Scene white_sphere(float radius_mm = 20) {
    Scene scene;
    scene.objects.push_back(
        {.name = "sphere", .mesh = test::sphere(radius_mm, 4), .classes = {MaterialClass::skin}});
    scene.lights.push_back({.intensity = kPi, .to_light_world = normalize(Vec3{1, 0.5f, 1}), .is_key = true});
    scene.camera = {
        .eye_mm = {0, 0, radius_mm * 8}, .vertical_fov_rad = 0.3f, .near_mm = 1, .far_mm = radius_mm * 20};
    scene.environment.kind = EnvironmentKind::none;
    scene.background_linear = {0.25f, 0.5f, 0.75f};
    return scene;
}

ReferenceSettings small(Integrator integrator, int samples = 8) {
    ReferenceSettings settings{
        .integrator = integrator, .width = 24, .height = 24, .samples = samples, .probes = 16};
    settings.lighting.specular = SpecularReflection::none;
    return settings;
}

Vec3 pixel(const Image& image, int x, int y) {
    return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
}

// Radiance 1 from everywhere, as a file.
std::filesystem::path white_panorama() {
    const std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) / "dermis_white_panorama.exr";
    Image white(32, 16, 3);
    for (float& value : white.floats()) value = 1;
    EXPECT_TRUE(write_image(path, white));
    return path;
}

void light_from_everywhere(Scene& scene) {
    scene.lights[0].intensity = 0;
    scene.environment = {.kind = EnvironmentKind::file, .file = white_panorama()};
}

TEST(ReferencePicture, lambert_in_the_middle_is_albedo_times_cosine) {
    Scene scene = white_sphere();
    scene.objects[0].mesh.materials[0].base_color_linear = {0.8f, 0.4f, 0.2f};
    ReferenceSettings settings = small(Integrator::lambert, 2);
    settings.width = settings.height = 25;
    settings.filter = PixelFilter::center;
    const auto picture = render_reference(scene, settings);
    ASSERT_TRUE(picture) << picture.error().message;
    const float cosine = normalize(Vec3{1, 0.5f, 1}).z;
    const Vec3 middle = pixel(picture->radiance, 12, 12);
    EXPECT_NEAR(middle.x, 0.8f * cosine, 1e-3);
    EXPECT_NEAR(middle.z, 0.2f * cosine, 1e-3);
    EXPECT_EQ(picture->radiance.at(12, 12, 3), 1);
    EXPECT_EQ(picture->radiance.at(0, 0, 3), 0);
    EXPECT_EQ(pixel(picture->radiance, 0, 0), (Vec3{0.25f, 0.5f, 0.75f}));
}

TEST(ReferencePicture, a_profile_of_no_width_is_lambert) {
    Scene scene = white_sphere();
    ReferenceSettings settings = small(Integrator::surface, 4);
    settings.filter = PixelFilter::center;
    settings.lighting.penumbra_mm = 0;
    const auto lambert = render_reference(scene, small(Integrator::lambert, 4));
    settings.width_scale = 0;
    settings.filter = PixelFilter::box;
    const auto none = render_reference(scene, settings);
    settings.width_scale = 1e-3;
    const auto narrow = render_reference(scene, settings);
    ASSERT_TRUE(none && narrow && lambert);
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
            EXPECT_EQ(pixel(none->radiance, x, y), pixel(lambert->radiance, x, y));
            EXPECT_NEAR(length(pixel(narrow->radiance, x, y) - pixel(lambert->radiance, x, y)), 0, 2e-3);
        }
}

TEST(ReferencePicture, a_wide_profile_is_not_lambert) {
    const auto lambert = render_reference(white_sphere(5), small(Integrator::lambert));
    const auto surface = render_reference(white_sphere(5), small(Integrator::surface));
    double difference = 0;
    for (int i = 0; i < 24; ++i)
        difference += length(pixel(lambert->radiance, i, 12) - pixel(surface->radiance, i, 12));
    EXPECT_GT(difference / 24, 0.01);
}

TEST(ReferencePicture, under_a_constant_environment_a_white_sphere_has_its_radiance) {
    Scene scene = white_sphere();
    light_from_everywhere(scene);
    ReferenceSettings settings = small(Integrator::surface, 16);
    const auto picture = render_reference(scene, settings);
    ASSERT_TRUE(picture) << picture.error().message;
    double sum = 0;
    for (int y = 8; y < 16; ++y)
        for (int x = 8; x < 16; ++x) sum += picture->radiance.at(x, y, 1) / 64;
    EXPECT_NEAR(sum, 1, 0.01);
}

TEST(ReferencePicture, walks_without_absorption_return_all_the_light_that_enters) {
    Scene scene = white_sphere();
    light_from_everywhere(scene);
    for (const double eta : {1.0, 1.4}) {
        ReferenceSettings settings = small(Integrator::walk, 16);
        settings.medium = ScatteringMedium{{0.5, 0.7, 1}, {0, 0, 0}, 0.3, eta};
        settings.normalisation = Normalisation::none;
        const auto picture = render_reference(scene, settings);
        ASSERT_TRUE(picture) << picture.error().message;
        Vec3 sum;
        for (int y = 8; y < 16; ++y)
            for (int x = 8; x < 16; ++x) sum += pixel(picture->radiance, x, y) * (1.0f / 64);
        const double entering = eta > 1 ? 1 - diffuse_external_reflectance(eta) : 1;
        EXPECT_NEAR(sum.x, entering, 0.02) << eta;
        EXPECT_NEAR(sum.z, entering, 0.02) << eta;
        EXPECT_LT(double(picture->lost_walks), 1e-3 * double(picture->walks));
    }
}

TEST(ReferencePicture, a_walk_takes_every_profile) {
    Scene scene = white_sphere(4);
    for (const char* profile : {"gpu_gems_3", "burley:0.448,0.104,0.067", "jensen_skin1"}) {
        scene.skin.profile = profile;
        const auto lambert = render_reference(scene, small(Integrator::lambert, 8));
        const auto surface = render_reference(scene, small(Integrator::surface, 64));
        const auto walk = render_reference(scene, small(Integrator::walk, 8));
        ASSERT_TRUE(walk) << walk.error().message;
        // Red light reaches past the terminator, and further than blue, as by the surface integral.
        double bled[3] = {}, expected[3] = {};
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 24; ++x)
                if (lambert->radiance.at(x, y, 0) < 0.01f && lambert->radiance.at(x, y, 3) == 1)
                    for (int c = 0; c < 3; ++c) {
                        bled[c] += walk->diffuse.at(x, y, c);
                        expected[c] += surface->diffuse.at(x, y, c);
                    }
        EXPECT_GT(bled[0], 1.5 * bled[2]) << profile;
        EXPECT_GT(bled[0], 0.5 * expected[0]) << profile;
        EXPECT_LT(bled[0], 2 * expected[0]) << profile;
    }
    scene.skin.profile = "jensen";
    EXPECT_FALSE(render_reference(scene, small(Integrator::walk)));
}

TEST(ReferencePicture, a_walk_of_no_width_is_the_light_that_enters) {
    const Scene scene = white_sphere();
    ReferenceSettings settings = small(Integrator::walk, 16);
    settings.medium = ScatteringMedium{{1, 1, 1}, {0.2, 0.2, 0.2}, 0, 1.4};
    settings.width_scale = 0;
    const auto none = render_reference(scene, settings);
    settings.width_scale = 1e-3;
    settings.probes = 64;
    const auto narrow = render_reference(scene, settings);
    ASSERT_TRUE(none && narrow);
    double difference = 0, sum = 0;
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
            difference += narrow->diffuse.at(x, y, 1) - none->diffuse.at(x, y, 1);
            sum += none->diffuse.at(x, y, 1);
        }
    EXPECT_NEAR(difference / sum, 0, 0.01);
}

TEST(ReferencePicture, twice_the_light_is_twice_the_radiance) {
    Scene scene = white_sphere();
    const auto once = render_reference(scene, small(Integrator::surface, 2));
    scene.lights[0].intensity *= 2;
    const auto twice = render_reference(scene, small(Integrator::surface, 2));
    for (int i = 6; i < 18; ++i)
        EXPECT_NEAR(length(pixel(twice->radiance, i, 12) - pixel(once->radiance, i, 12) * 2.0f), 0, 1e-4);
}

TEST(ReferencePicture, threads_change_nothing_and_seeds_do) {
    const Scene scene = white_sphere(4);
    ReferenceSettings settings = small(Integrator::surface, 3);
    settings.lighting.penumbra_mm = 2;
    const auto all = render_reference(scene, settings);
    set_thread_limit(1);
    const auto one = render_reference(scene, settings);
    set_thread_limit(0);
    EXPECT_EQ(all->radiance.bytes, one->radiance.bytes);
    EXPECT_EQ(all->variance.bytes, one->variance.bytes);
    settings.seed = 2;
    EXPECT_NE(render_reference(scene, settings)->radiance.bytes, all->radiance.bytes);
}

TEST(ReferencePicture, the_stated_variance_is_the_one_that_seeds_show) {
    const Scene scene = white_sphere(3);
    ReferenceSettings settings = small(Integrator::surface, 16);
    settings.width = settings.height = 12;
    settings.probes = 6;
    constexpr int kRuns = 24;
    std::vector<double> sum(144), squares(144), stated(144);
    for (int run = 0; run < kRuns; ++run) {
        settings.seed = uint32_t(run) + 1;
        const auto picture = render_reference(scene, settings);
        for (size_t i = 0; i < 144; ++i) {
            const double value = picture->radiance.floats()[4 * i];
            sum[i] += value;
            squares[i] += value * value;
            stated[i] += picture->variance.floats()[3 * i] / kRuns;
        }
    }
    double seen = 0, said = 0;
    for (size_t i = 0; i < 144; ++i) {
        seen += (squares[i] - sum[i] * sum[i] / kRuns) / (kRuns - 1);
        said += stated[i];
    }
    // Stratified positions within the pixel make the result slightly better than independent ones would.
    EXPECT_LT(seen, said * 1.25);
    EXPECT_GT(seen, said * 0.3);
}

TEST(ReferencePicture, a_wanted_error_is_reached_with_fewer_samples_than_allowed) {
    ReferenceSettings settings = small(Integrator::surface, 4000);
    settings.noise = 0.02;
    const auto picture = render_reference(white_sphere(4), settings);
    ASSERT_TRUE(picture);
    EXPECT_LE(picture->relative_error, 0.02);
    EXPECT_GT(picture->relative_error, 0.0);
    EXPECT_LT(picture->passes, 4000);
    EXPECT_TRUE(picture->reached_noise);
}

TEST(ReferencePicture, an_error_that_is_not_reached_is_reported) {
    ReferenceSettings settings = small(Integrator::surface, 16);
    settings.noise = 0.001;
    const auto picture = render_reference(white_sphere(4), settings);
    ASSERT_TRUE(picture);
    EXPECT_GT(picture->relative_error, 0.001);
    EXPECT_FALSE(picture->reached_noise);
}

TEST(ReferencePicture, stopping_keeps_the_complete_passes) {
    std::atomic<bool> stop = false;
    const auto picture = render_reference(
        white_sphere(), small(Integrator::surface, 1000), [&](double) { stop = true; }, &stop);
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->passes, 1);
    EXPECT_EQ(picture->samples.at(0, 0, 0), 1);
    EXPECT_FALSE(render_reference(white_sphere(), small(Integrator::surface), {}, &stop));
}

TEST(ReferencePicture, tinted_glass_colours_the_light_behind_it) {
    // A skin plane under a pane of half its width, light from above, seen from the side of the light.
    Scene scene = white_sphere();
    Mesh floor = test::plane(100, 0), pane = test::grid(1, 1, [](float u, float v) {
                                          return test::Placed{{50 * u, (0.5f - v) * 100, 200}, {0, 0, 1}};
                                      });
    pane.materials[0] = {.base_color_linear = {0.5f, 1, 0.25f}, .opacity = 0.5f};
    scene.objects = {{.name = "floor", .mesh = floor, .classes = {MaterialClass::skin}},
                     {.name = "pane", .mesh = pane, .classes = {MaterialClass::translucent}}};
    scene.lights[0].to_light_world = {0, 0, 1};
    scene.camera = {.eye_mm = {0, 0, 100}, .vertical_fov_rad = 0.6f, .near_mm = 1, .far_mm = 1000};
    const auto picture = render_reference(scene, small(Integrator::lambert, 2));
    ASSERT_TRUE(picture);
    EXPECT_NEAR(length(pixel(picture->radiance, 4, 12) - Vec3{1, 1, 1}), 0, 1e-3);
    EXPECT_NEAR(length(pixel(picture->radiance, 20, 12) - Vec3{0.25f, 0.5f, 0.125f}), 0, 1e-3);
}

TEST(ReferencePicture, light_of_a_point_falls_with_the_square_of_the_distance_in_metres) {
    Light light{.kind = LightKind::point, .intensity = 2, .position_mm = {0, 0, 500}};
    EXPECT_NEAR(light_at(light, {0, 0, 0}).irradiance_linear.x, 8, 1e-4);
    light.kind = LightKind::spot;
    light.to_light_world = {0, 0, 1};
    EXPECT_NEAR(light_at(light, {0, 0, 0}).irradiance_linear.x, 8, 1e-4);
    EXPECT_EQ(light_at(light, {400, 0, 0}).irradiance_linear.x, 0);
    const float between = light_at(light, {230, 0, 0}).irradiance_linear.x;
    EXPECT_GT(between, 0.1f);
    EXPECT_LT(between, 6);
}

TEST(ReferencePicture, a_penumbra_is_as_wide_as_it_is_set) {
    Scene scene = white_sphere();
    Mesh floor = test::plane(100, 0),
         lid = test::grid(1, 1, [](float u, float v) {
             return test::Placed{{-50 * (1 - u), (0.5f - v) * 100, 200}, {0, 0, 1}};
         });
    scene.objects = {{.name = "floor", .mesh = floor, .classes = {MaterialClass::skin}},
                     {.name = "lid", .mesh = lid, .classes = {MaterialClass::other}}};
    scene.lights[0].to_light_world = {0, 0, 1};
    scene.camera = {.eye_mm = {0, 0, 100}, .vertical_fov_rad = 0.2f, .near_mm = 1, .far_mm = 150};
    ReferenceSettings settings = small(Integrator::lambert, 64);
    settings.lighting.penumbra_mm = 6;
    const auto picture = render_reference(scene, settings);
    const double mm_per_pixel = 2 * 100 * std::tan(0.1) / 24;
    for (int x = 0; x < 24; ++x) {
        const double from_edge_mm = (x + 0.5 - 12) * mm_per_pixel,
                     s = std::clamp(from_edge_mm / 3, -1.0, 1.0);
        const double lit = 0.5 + (s * std::sqrt(1 - s * s) + std::asin(s)) / std::numbers::pi;  // of a disk
        EXPECT_NEAR(picture->radiance.at(x, 12, 0), lit, 0.12) << from_edge_mm;
    }
}

TEST(ReferencePicture, settings_out_of_range_are_refused_by_name) {
    const Scene scene = white_sphere();
    ReferenceSettings settings = small(Integrator::surface);
    settings.samples = 1;
    EXPECT_NE(render_reference(scene, settings).error().message.find("samples"), std::string::npos);
    settings = small(Integrator::surface);
    settings.probes = -1;
    EXPECT_NE(render_reference(scene, settings).error().message.find("probes"), std::string::npos);
    settings = small(Integrator::surface);
    settings.width = 0;
    EXPECT_FALSE(render_reference(scene, settings));
    settings = small(Integrator::surface);
    settings.noise = 2;
    EXPECT_FALSE(render_reference(scene, settings));
}

}  // namespace
}  // namespace dermis
