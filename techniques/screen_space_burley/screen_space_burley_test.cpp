#include "techniques/screen_space_burley/tables.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/optics/presets.h"
#include "render/render_test.h"

using namespace dermis;
using namespace dermis::screen_space_burley;

namespace {

constexpr int kCount = 512;

double radius_mm(double reach, int i) {
    const double x = double(i) / (kCount - 1);
    return reach * x * x;
}

// Decibels of red against many samples; the peak is the brightest pixel.
double psnr_db(const Image& image, const Image& many) {
    double squares = 0, peak = 0;
    for (size_t i = 0; i < image.pixel_count(); ++i) {
        const double difference = image.floats()[4 * i] - many.floats()[4 * i];
        squares += difference * difference;
        peak = std::max(peak, double(many.floats()[4 * i]));
    }
    return 10 * std::log10(peak * peak * double(image.pixel_count()) / squares);
}

class ScreenSpaceBurley : public RenderTest {
  protected:
    static Image draw(Renderer& renderer, const std::string& samples) {
        const Technique& technique = built_in_technique("screen_space_burley");
        ParameterValues values = without_gain(ParameterValues(technique.parameters));
        EXPECT_TRUE(values.set("samples", samples));
        return radiance(
            renderer, technique, values,
            {.width = 128, .height = 128, .view = "diffuse", .deep = true, .shadow_map_size = 1024});
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
    const Image many = draw(renderer, "2048");
    double before_db = 0;
    for (const char* samples : {"8", "32", "128"}) {
        const double db = psnr_db(draw(renderer, samples), many);
        RecordProperty(std::string("psnr_db_") + samples, std::to_string(db));
        EXPECT_GT(db, before_db + 3) << samples;
        before_db = db;
    }
    EXPECT_GT(before_db, 40);
}
