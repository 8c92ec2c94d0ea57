// Profile CSVs: round trips, refusals with their messages, and every prefix of a file.

#include "dermis/optics/profile_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

std::string csv_verdict(std::string_view csv) {
    const Result<Profile> profile = parse_profile_csv(csv, "skin.csv");
    return profile ? std::string("valid") : profile.error().message;
}

constexpr std::string_view kTable =
    "# measured\r\n"
    "r_mm, r, g, b\r\n"
    "0.1,0.3,0.2,0.1\r\n"
    "\r\n"
    "0.5,0.1,0.05,0\r\n"
    "2,0.01,0,0\r\n";

}  // namespace

TEST(ProfileFile, a_table_is_linear_between_its_rows) {
    const Result<Profile> profile = parse_profile_csv(kTable, "dir/skin.csv");
    ASSERT_TRUE(profile);
    EXPECT_EQ(profile->name, "skin");
    EXPECT_EQ(model_name(*profile), "table");
    EXPECT_DOUBLE_EQ(reflectance_per_mm2(*profile, kRed, 0), 0.3);
    EXPECT_DOUBLE_EQ(reflectance_per_mm2(*profile, kRed, 0.3), 0.2);
    EXPECT_DOUBLE_EQ(reflectance_per_mm2(*profile, kRed, 2), 0.01);
    EXPECT_EQ(reflectance_per_mm2(*profile, kRed, 2.1), 0);
    EXPECT_EQ(inverse_cdf_mm(*profile, kRed, 1), 2);
}

TEST(ProfileFile, sums_of_gaussians_come_back_as_they_were_written) {
    const Profile skin = *find_profile("gpu_gems_3");
    const Result<Profile> back = parse_profile_csv(profile_csv(skin, {}), "gpu_gems_3.csv");
    ASSERT_TRUE(back);
    const auto& sum = std::get<GaussianSum>(back->model);
    const auto& expected = std::get<GaussianSum>(skin.model);
    ASSERT_EQ(sum.terms.size(), 6u);
    for (size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(sum.terms[i].variance_mm2, expected.terms[i].variance_mm2);
        EXPECT_EQ(sum.terms[i].weight, expected.terms[i].weight);
    }
}

TEST(ProfileFile, a_fine_table_of_a_dipole_is_that_dipole) {
    const Profile skin = *find_profile("jensen_skin1");
    std::vector<double> radii;
    for (int i = 0; i <= 2000; ++i) radii.push_back(0.03 * i);
    const Result<Profile> table = parse_profile_csv(profile_csv(skin, radii), "t.csv");
    ASSERT_TRUE(table);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(diffuse_albedo(*table, c), diffuse_albedo(skin, c), 1e-3);
        EXPECT_NEAR(mean_radius_mm(*table, c), mean_radius_mm(skin, c), 5e-3);
    }
}

TEST(ProfileFile, refusals_name_the_place_the_value_and_what_would_be_right) {
    EXPECT_EQ(csv_verdict("r_mm,r,g,b\n0,1,1,1\n1,0,0,0\n"), "valid");
    EXPECT_THAT(csv_verdict(""), HasSubstr("skin.csv: empty; its first line must be 'r_mm,r,g,b'"));
    EXPECT_THAT(csv_verdict("radius;r;g;b\n"), HasSubstr("skin.csv:1: the header is 'radius;r;g;b'"));
    EXPECT_THAT(csv_verdict("r_mm,r,g,b\n0,1,1\n"), HasSubstr("skin.csv:2: 3 values; a row has 4"));
    EXPECT_THAT(csv_verdict("r_mm,r,g,b\n0,1,x,1\n"), HasSubstr("skin.csv:2: 'x' is not a number"));
    EXPECT_THAT(csv_verdict("r_mm,r,g,b\n0,1,1,1\n"),
                HasSubstr("the number of rows is 1; it must be 2 to 100000"));
    EXPECT_THAT(csv_verdict("r_mm,r,g,b\n0,1,1,1\n2,1,1,1\n1,1,1,1\n"),
                HasSubstr("r_mm of row 3 is 1; it must be above the row before, 2"));
    EXPECT_THAT(csv_verdict("r_mm,r,g,b\n1,1,1,1\n1,1,1,1\n"), HasSubstr("r_mm of row 2 is 1"));
    EXPECT_THAT(csv_verdict("r_mm,r,g,b\n-1,1,1,1\n1,1,1,1\n"),
                HasSubstr("r_mm of row 1 is -1; it must be >= 0"));
    EXPECT_THAT(csv_verdict("r_mm,r,g,b\n0,1,1,1\n1,nan,1,1\n"),
                HasSubstr("the red reflectance of row 2 is nan"));
    EXPECT_THAT(csv_verdict("r_mm,r,g,b\n0,1,-1,1\n1,1,1,1\n"),
                HasSubstr("the green reflectance of row 1 is -1"));
    EXPECT_THAT(csv_verdict("r_mm,r,g,b\n0,0,0,0\n1,0,0,0\n"), HasSubstr("no reflectance at all"));
    EXPECT_THAT(csv_verdict("r_mm,r,g,b\n0,1,1,1\n12e-83,1,1,1\n"),
                HasSubstr("the last r_mm is 1.2e-82; it must be at least 1e-6"));
    EXPECT_THAT(csv_verdict("variance_mm2,r,g,b\n"), HasSubstr("the sum of Gaussians is empty"));
    EXPECT_THAT(csv_verdict("variance_mm2,r,g,b\n0,1,1,1\n"), HasSubstr("variance_mm2 of term 1 is 0"));
    EXPECT_THAT(csv_verdict("variance_mm2,r,g,b\n1,-1,1,1\n"), HasSubstr("red weight of term 1 is -1"));
}

// An annulus from 3 to 3 + width mm: the light leaves at its mean radius, however narrow it is.
TEST(ProfileFile, a_step_between_neighbouring_numbers_has_its_radius) {
    for (const double width : {1e-3, 1e-9, 1e-15}) {
        const std::vector<double> radii = {0, 3, 3 + width};
        const std::vector<std::array<double, 3>> values = {{0, 0, 0}, {0, 0, 0}, {1, 1, 1}};
        const Profile step{"step", "test", *TabulatedProfile::make(radii, values, "step")};
        EXPECT_NEAR(diffuse_albedo(step, kRed) / (3 * std::numbers::pi * (radii[2] - 3)), 1, width);
        EXPECT_NEAR(mean_radius_mm(step, kRed), 3, 1e-12 + width);
        EXPECT_NEAR(inverse_cdf_mm(step, kRed, 0.5), 3, 1e-12 + width);
    }
}

// All light within 1e-160 mm: the moments underflow, the median is found nevertheless.
TEST(ProfileFile, a_profile_that_is_nearly_a_point_has_a_median) {
    const Result<Profile> point = parse_profile_csv("r_mm,r,g,b\n0,1,1,1\n1e-160,0,0,0\n1,0,0,0\n", "p.csv");
    ASSERT_TRUE(point);
    EXPECT_LT(inverse_cdf_mm(*point, kRed, 0.5), 1e-6);
}

TEST(ProfileFile, every_prefix_is_read_or_refused_in_one_line) {
    const std::string sum = profile_csv(*find_profile("gpu_gems_3"), {});
    for (const std::string_view file : {kTable, std::string_view(sum)})
        for (size_t length = 0; length < file.size(); ++length) {
            const Result<Profile> profile = parse_profile_csv(file.substr(0, length), "skin.csv");
            if (profile) {
                EXPECT_TRUE(check(*profile));
                EXPECT_GE(inverse_cdf_mm(*profile, kRed, 0.5), 0);
            } else {
                EXPECT_THAT(profile.error().message, HasSubstr("skin.csv"));
                EXPECT_EQ(profile.error().message.find('\n'), std::string::npos);
            }
        }
}

TEST(GaussianFit, states_its_error_and_keeps_it_small_for_every_preset) {
    for (const std::string& name : profile_names()) {
        const Profile profile = *find_profile(name);
        const GaussianFit fit = to_gaussian_sum(profile, 6);
        const Profile fitted{"fit", "test", fit.sum};
        ASSERT_TRUE(check(fitted)) << name;
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(diffuse_albedo(fitted, c), diffuse_albedo(profile, c), 1e-12) << name;
            EXPECT_NEAR(mean_radius_mm(fitted, c), mean_radius_mm(profile, c),
                        7e-3 * mean_radius_mm(profile, c))
                << name;
            EXPECT_LE(fit.max_error[size_t(c)], 0.0025) << name;
            EXPECT_LE(fit.rms_error[size_t(c)], fit.max_error[size_t(c)]) << name;
            // The stated error holds between the fitted radii too.
            double largest = 0;
            for (double u = 0.0015; u < 0.9995; u += 0.0037) {
                const double r = inverse_cdf_mm(profile, c, u);
                largest = std::max(largest, std::abs(cdf(fitted, c, r) - cdf(profile, c, r)));
            }
            EXPECT_LE(largest, fit.max_error[size_t(c)] * 1.05 + 1e-12) << name;
        }
    }
}

TEST(GaussianFit, more_terms_are_better_and_sums_of_gaussians_stay_themselves) {
    const Profile burley = *find_profile("burley:1");
    double last = 1;
    for (const int terms : {1, 2, 4, 8}) {
        const double error = to_gaussian_sum(burley, terms).max_error[0];
        EXPECT_LT(error, 0.6 * last) << terms;
        last = error;
    }
    EXPECT_LT(last, 8e-4);
    const GaussianFit same = to_gaussian_sum(*find_profile("gpu_gems_3"), 2);
    EXPECT_EQ(same.sum.terms.size(), 6u);
    EXPECT_EQ(same.max_error[0], 0);
}

TEST(GaussianFit, a_table_is_fitted_like_any_other_and_a_dark_channel_has_no_terms) {
    const Profile table = *parse_profile_csv("r_mm,r,g,b\n0,1,0,0.5\n1,0.2,0,0.1\n3,0,0,0\n", "t.csv");
    const GaussianFit fit = to_gaussian_sum(table, 4);
    EXPECT_LT(fit.max_error[0], 0.04) << "an end at 3 mm is nothing Gaussians can follow";
    EXPECT_EQ(fit.max_error[1], 0);
    for (const GaussianTerm& term : fit.sum.terms) EXPECT_EQ(term.weight[1], 0);
}
