// The published curves, compared with what the article shows of them.

#include "dermis/optics/curve_2015.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dermis/bake/fit_errors.h"
#include "dermis/optics/presets.h"

using namespace dermis;

TEST(Curve2015, is_the_table_at_large_radii) {
    for (double t = -1; t <= 1; t += 0.125)
        for (size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(curve_2015_direct(t, 1.0 / 16)[c], preintegrated_diffuse(gpu_gems_3_skin(), t, 16)[c],
                        0.013)
                << t << " " << c;
}

TEST(Curve2015, rises_with_n_dot_l_and_is_red_past_the_terminator_at_small_radii) {
    for (const double curvature : {1.0 / 2, 1.0 / 4, 1.0 / 8})
        for (size_t c = 0; c < 3; ++c)
            for (double t = -1; t < 0.99; t += 0.01)
                EXPECT_GE(curve_2015_direct(t + 0.01, curvature)[c],
                          curve_2015_direct(t, curvature)[c] - 1e-12);
    const Rgb dark = curve_2015_direct(-0.3, 0.5);
    EXPECT_GT(dark[0], 0.1);
    EXPECT_LT(dark[2], 0.02);
}

TEST(Curve2015, counts_radii_outside_2_to_16_mm_as_those) {
    EXPECT_EQ(curve_2015_direct(0.2, 1), curve_2015_direct(0.2, 0.5));
    EXPECT_EQ(curve_2015_direct(0.2, 0), curve_2015_direct(0.2, 0.0625));
    EXPECT_EQ(curve_2015_zonal(7), curve_2015_zonal(0.5));
}

TEST(Curve2015, has_the_harmonics_of_a_ring_that_does_not_conserve_energy) {
    const auto tight = curve_2015_zonal(0.5), flat = curve_2015_zonal(1.0 / 16);
    EXPECT_NEAR(tight[0][0], 1.02, 0.01) << "the article's own; the sphere has 0.886";
    for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(flat[0][c], 0.886227, 0.02);
        EXPECT_NEAR(flat[1][c], preintegrated_zonal_harmonics(gpu_gems_3_skin(), 16)[1][c], 0.005);
    }
}

// Red at 2 mm, past the terminator. On the lit end no ring fits: at N.L = 1 the curve has .99, the rings .80
// to .89.
TEST(Curve2015, were_fitted_to_the_full_ring_with_variances_times_1_414) {
    const auto rms = [](const Preintegration& how) {
        double squares = 0;
        constexpr int kSteps = 100;
        for (int i = 0; i <= kSteps; ++i) {
            const double t = -double(i) / kSteps;
            const double d =
                curve_2015_direct(t, 0.5)[0] - preintegrated_diffuse(gpu_gems_3_skin(), t, 2, how)[0];
            squares += d * d;
        }
        return std::sqrt(squares / (kSteps + 1));
    };
    EXPECT_NEAR(rms(kYeung2015Ring), 0.0055, 0.0005);
    EXPECT_NEAR(rms({.construction = Construction::half_ring}), 0.040, 0.002);
    for (const Construction shape : {Construction::full_ring, Construction::half_ring, Construction::sphere})
        for (const double scale : {1.0, 1.414})
            EXPECT_GE(rms({.construction = shape, .variance_scale = scale}), rms(kYeung2015Ring));
    EXPECT_NEAR(curve_2015_direct(1, 0.5)[0], 0.99, 0.005);
    EXPECT_NEAR(preintegrated_diffuse(gpu_gems_3_skin(), 1, 2, kYeung2015Ring)[0], 0.80, 0.005);
}

TEST(FitErrors, find_the_closed_form_within_half_a_code_from_1_to_100_mm_and_the_curves_far_out) {
    const Result<ClosedForm> form = fit_closed_form(gpu_gems_3_skin(), 1, 257);
    ASSERT_TRUE(form);
    const double radii[] = {1, 1.4, 2, 3, 4, 8, 16, 32, 100};
    const std::vector<FitErrors> errors = measure_fit_errors(*form, gpu_gems_3_skin(), radii);
    ASSERT_EQ(errors.size(), 9u);
    for (const FitErrors& e : errors)
        for (size_t c = 0; c < 3; ++c) EXPECT_LT(e.closed_form[c], 0.5 / 255) << e.radius_mm;
    EXPECT_NEAR(errors[2].curve_sphere[0], 0.20, 0.01);
    EXPECT_LT(errors[2].curve_ring[0], errors[2].curve_sphere[0]);
    EXPECT_GT(errors[0].curve_sphere[0], 0.2);
}

TEST(FitErrors, become_a_table_and_a_plot) {
    const std::vector<FitErrors> errors = {
        {.radius_mm = 2, .closed_form = {0.001, 0.002, 0}, .curve_sphere = {0.2, 0, 0}}};
    EXPECT_NE(fit_error_table(errors).find("| 2 | 0.00200 | 0.2000 | 0.0000 |"), std::string::npos);
    EXPECT_EQ(fit_error_plot(errors, "p").panels[0].series.size(), 10u);
}

TEST(Curve2015, of_2_mm_goes_from_its_dark_piece_to_its_light_piece) {
    for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(curve_2015_direct(-1, 0.5)[c], curve_2015_tight_pieces(c, -1).dark, 1e-12);
        EXPECT_NEAR(curve_2015_direct(1, 0.5)[c], curve_2015_tight_pieces(c, 1).light, 1e-12);
        const TightPieces middle = curve_2015_tight_pieces(c, 0.1);
        const double mixed = curve_2015_direct(0.1, 0.5)[c];
        EXPECT_GE(mixed, std::min(middle.dark, middle.light));
        EXPECT_LE(mixed, std::max(middle.dark, middle.light));
    }
}
