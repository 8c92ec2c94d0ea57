#include "techniques/screen_space_burley/tables.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/optics/presets.h"
#include "techniques/screen_space_burley/constants.h"
#include "techniques/screen_space_burley/test_pictures.h"

using namespace dermis;
using namespace dermis::screen_space_burley;

namespace {

constexpr int kCount = 512;

double radius_mm(double reach, int i) {
    const double x = double(i) / (kCount - 1);
    return reach * x * x;
}

class ScreenSpaceBurley : public ScreenSpaceBurleyTest {
  protected:
    // Of the pixels with skin.
    static double mean_samples(Renderer& renderer, Settings settings, int most) {
        settings.emplace_back("samples", std::to_string(most));
        const Image counts = draw(renderer, settings, "sample_count");
        double sum = 0, pixels = 0;
        for (size_t i = 0; i < counts.pixel_count(); ++i)
            if (counts.floats()[4 * i] > 0) sum += most * double(counts.floats()[4 * i]), ++pixels;
        return sum / pixels;
    }
};

}  // namespace

TEST(BurleyTables, a_density_integrates_to_the_part_within) {
    for (const char* name : {"gpu_gems_3", "jensen_skin1", "burley:0.8,0.4,0.2"}) {
        const Result<Profile> profile = find_profile(name);
        ASSERT_TRUE(profile) << name;
        const double reach = reach_mm(*profile);
        const std::vector<Texel> density = radial_density(*profile, reach, kCount);
        const std::vector<Texel> part = part_within(*profile, reach, kCount);
        std::array<double, 3> sum = {};
        for (int i = 1; i < kCount; ++i)
            for (size_t c = 0; c < 3; ++c) {
                const double step = radius_mm(reach, i) - radius_mm(reach, i - 1);
                sum[c] += step * (density[size_t(i)][c] + density[size_t(i) - 1][c]) / 2;
                if (i % 64 == 0) {
                    EXPECT_NEAR(sum[c], part[size_t(i)][c], 0.02) << name << c << i;
                }
            }
        EXPECT_NEAR(part[kCount - 1][0], 1, 1e-6) << name;
    }
}

TEST(BurleyTables, the_radius_of_a_part_is_the_inverse_of_the_mean_part) {
    const Profile profile = *find_profile("gpu_gems_3");
    const double reach = reach_mm(profile);
    const std::vector<float> radius = radius_of_part(profile, reach, 65);
    for (int i = 1; i < 64; ++i) {
        double mean = 0;
        for (int c = 0; c < 3; ++c) mean += cdf(profile, c, radius[size_t(i)]) / cdf(profile, c, reach) / 3;
        EXPECT_NEAR(mean, i / 64.0, 1e-5) << i;
    }
    EXPECT_FLOAT_EQ(radius[64], float(reach));
}

// More samples come nearer to what very many give: each factor of 4 by 3 dB or more.
TEST_F(ScreenSpaceBurley, converges_over_its_samples) {
    const Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    const Image many = draw(renderer, {{"samples", "2048"}});
    double before_db = 0;
    for (const char* samples : {"8", "32", "128"}) {
        const double db = psnr_db(draw(renderer, {{"samples", samples}}), many);
        RecordProperty(std::string("psnr_db_") + samples, std::to_string(db));
        EXPECT_GT(db, before_db + 3) << samples;
        before_db = db;
    }
    EXPECT_GT(before_db, 40);
}

// The bust from near, where the profile is wider than a pixel. One sample of the pilot for each pixel counts
// too.
TEST_F(ScreenSpaceBurley, an_adaptive_count_is_nearer_with_fewer_samples) {
    Scene scene = load("builtin:bust");
    scene.background_linear = {};
    scene.environment.visible = false;
    scene.camera.vertical_fov_rad /= 3;
    Renderer renderer = make_renderer(scene);
    const Settings adaptive = {{"count", "adaptive"}, {"noise", "0.003"}, {"samples", "64"}};
    const Image many = draw(renderer, {{"samples", "1024"}});
    const double fixed_db = psnr_db(draw(renderer, {{"samples", "16"}}), many);
    const double adaptive_db = psnr_db(draw(renderer, adaptive), many);
    const double samples = mean_samples(renderer, adaptive, 64) + kPilotSamples / 4.0;
    RecordProperty("samples", std::to_string(samples));
    RecordProperty("psnr_db", std::to_string(adaptive_db) + ", fixed " + std::to_string(fixed_db));
    EXPECT_LT(samples, 16);
    EXPECT_GT(adaptive_db, fixed_db + 0.5);
}

TEST_F(ScreenSpaceBurley, an_adaptive_count_is_least_where_light_does_not_vary) {
    Scene scene = evenly_lit_spheres();
    scene.background_linear = {};
    scene.environment.visible = false;
    Renderer renderer = make_renderer(scene);
    EXPECT_NEAR(mean_samples(renderer, {{"count", "adaptive"}}, 64), kFewestSamples, 0.1);
    const Image fixed = draw(renderer, {}), adaptive = draw(renderer, {{"count", "adaptive"}});
    EXPECT_LT(relative_difference(fixed, adaptive, 1), 1e-3) << "at silhouettes too";
}
