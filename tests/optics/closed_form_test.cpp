#include "dermis/optics/closed_form.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dermis/optics/profile.h"

using namespace dermis;

TEST(ClosedForm, is_within_one_code_of_the_integral_from_1_mm_up) {
    const Result<ClosedForm> form = fit_closed_form(gpu_gems_3_skin(), 1.0, 128);
    ASSERT_TRUE(form);
    double largest = 0;
    for (const double radius_mm : {1.0, 1.3, 2.0, 3.7, 4.0, 8.0, 16.0, 33.0, 100.0})
        for (double t = -1; t <= 1; t += 1.0 / 128) {
            const Rgb exact = preintegrated_diffuse(gpu_gems_3_skin(), t, radius_mm);
            const Rgb fitted = evaluate(*form, t, 1 / radius_mm);
            for (size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(exact[c] - fitted[c]));
        }
    RecordProperty("largest_error", std::to_string(largest));
    EXPECT_LT(largest, 0.0019);
    EXPECT_LT(form->max_error, 0.0018);
}

TEST(ClosedForm, its_odd_part_is_exact_and_flat_skin_is_lambert) {
    const Result<ClosedForm> form = fit_closed_form(gpu_gems_3_skin(), 0.5, 2);
    ASSERT_TRUE(form);
    for (const double t : {0.1, 0.5, 1.0}) {
        const Rgb lit = preintegrated_diffuse(gpu_gems_3_skin(), t, 2),
                  dark = preintegrated_diffuse(gpu_gems_3_skin(), -t, 2);
        const Rgb fitted_lit = evaluate(*form, t, 0.5), fitted_dark = evaluate(*form, -t, 0.5);
        for (size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(fitted_lit[c] - fitted_dark[c], lit[c] - dark[c], 1e-9) << t;
        EXPECT_EQ(evaluate(*form, t, 0)[0], t);
        EXPECT_EQ(evaluate(*form, -t, 0)[0], 0);
    }
}

TEST(ClosedForm, states_an_error_that_is_the_largest_found) {
    // A fit of a single wide Gaussian at one curvature, compared with the integral at the fit's own
    // curvature.
    const GaussianSum wide = {"wide", {{4.0, {1, 1, 1}}}};
    const Result<ClosedForm> form = fit_closed_form(wide, 0.5, 2);
    ASSERT_TRUE(form);
    double largest = 0;
    for (double t = -1; t <= 1; t += 1.0 / 256)
        largest =
            std::max(largest, std::abs(preintegrated_diffuse(wide, t, 2)[0] - evaluate(*form, t, 0.5)[0]));
    EXPECT_GT(largest, 0);
    EXPECT_NEAR(form->max_error, largest, 0.1 * largest);
}

TEST(ClosedForm, refuses_what_it_cannot_fit) {
    EXPECT_EQ(fit_closed_form(gpu_gems_3_skin(), 0.5, 1).error().message, "closed form: 1 rows; 2 to 65536");
    EXPECT_EQ(fit_closed_form(gpu_gems_3_skin(), -1, 8).error().message,
              "closed form: largest curvature -1 per mm; more than 0");
    EXPECT_FALSE(fit_closed_form({"none", {}}, 0.5, 8));
}
