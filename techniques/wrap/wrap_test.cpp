#include <gtest/gtest.h>

#include "dermis/optics/preintegration.h"
#include "render/grid_scene.h"

using namespace dermis;

namespace {

class Wrap : public GridTest {
  protected:
    static Image draw(Settings settings, const char* width = "source") {
        settings.emplace_back("specular", "none");
        settings.emplace_back("width", width);
        return draw_grid(make_grid_scene(), built_in_technique("wrap"), settings);
    }
    /// Over all cosines, which are even steps over x; Lambert's is 1/4.
    static double mean(const Image& image, int channel) {
        double sum = 0;
        for (int x = 0; x < kGrid; ++x) sum += image.at(x, 0, channel);
        return sum / kGrid;
    }
};

}  // namespace

TEST_F(Wrap, keeps_the_energy_at_every_reach) {
    for (const char* reach : {"0", "0.25", "0.5", "1"})
        EXPECT_NEAR(mean(draw({{"wrap", reach}, {"scatter_color_linear", "0"}}), 0), 0.25, 5e-4) << reach;
}

TEST_F(Wrap, keeps_the_energy_of_every_colour_at_every_curvature) {
    const Image image = draw({}, "profile");
    for (int y = 0; y < kGrid; y += 7)
        for (int c = 0; c < 3; ++c) {
            double sum = 0;
            for (int x = 0; x < kGrid; ++x) sum += double(image.at(x, y, c));
            EXPECT_NEAR(sum / kGrid, 0.25, 5e-4) << y << ", channel " << c;
        }
}

// Against the integral over the sphere, for the curvatures of spheres of 1 to 16 mm.
TEST_F(Wrap, is_nearer_to_the_profile_than_lambert_in_every_colour_at_every_curvature) {
    const Image image = draw({}, "profile");
    double wrapped_squared[3] = {}, lambert_squared[3] = {};
    for (int y = 3; y < kGrid; y += 4)
        for (int c = 0; c < 3; ++c) {
            double wrapped = 0, lambert = 0;
            for (int x = 0; x < kGrid; ++x) {
                const double t = grid_cosine(x), cosine = std::max(t, 0.0);
                const double exact =
                    preintegrated_diffuse(gpu_gems_3_skin(), t, 1 / grid_curvature_per_mm(y))[size_t(c)];
                wrapped += std::pow(double(image.at(x, y, c)) - exact, 2);
                lambert += std::pow(cosine - exact, 2);
            }
            EXPECT_LT(wrapped, lambert) << grid_curvature_per_mm(y) << " per mm, channel " << c;
            wrapped_squared[c] += wrapped, lambert_squared[c] += lambert;
        }
    EXPECT_LT(wrapped_squared[0], 0.22 * lambert_squared[0]);  // captured share 0.55
}

TEST_F(Wrap, the_coloured_band_adds_3_percent_in_red_and_less_than_1_in_green_and_blue) {
    const Image image = draw({});
    EXPECT_NEAR(mean(image, 0), 0.25 * 1.033, 5e-4);
    EXPECT_LT(mean(image, 1), 0.25 * 1.01);
    EXPECT_LT(mean(image, 2), mean(image, 1));
}

TEST_F(Wrap, light_reaches_past_the_terminator_as_far_as_wrap_says) {
    const Image image = draw({{"wrap", "0.4"}});
    for (int x = 0; x < kGrid; ++x) {
        if (grid_cosine(x) < -0.4) {
            EXPECT_EQ(image.at(x, 0, 0), 0.0f) << x;
        } else {
            EXPECT_GT(image.at(x, 0, 0), 0.0f) << x;
        }
    }
}

TEST_F(Wrap, the_terminator_is_red_and_the_lit_side_grey) {
    const Image image = draw({});
    const int terminator = kGrid / 2, lit = kGrid - 1;
    EXPECT_GT(image.at(terminator, 0, 0), 1.2f * image.at(terminator, 0, 1));
    EXPECT_GT(image.at(terminator, 0, 1), image.at(terminator, 0, 2));
    EXPECT_NEAR(image.at(lit, 0, 0), image.at(lit, 0, 2), 1e-5);
}
