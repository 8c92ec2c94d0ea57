// Physical laws that every model of a profile keeps, and the published numbers of each.

#include "dermis/optics/profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "dermis/optics/burley_scaling.h"
#include "dermis/optics/presets.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

using Rgb = std::array<double, 3>;

Profile small_table() {
    const std::vector<double> r = {0.1, 0.5, 2, 3};
    const std::vector<Rgb> values = {{0.3, 0.2, 0}, {0.1, 0.05, 0}, {0.01, 0, 0}, {0, 0, 0}};
    return {"table", "test", *TabulatedProfile::make(r, values, "test")};
}

std::vector<Profile> one_of_each() {
    std::vector<Profile> profiles = {small_table()};
    for (const std::string& name : profile_names()) profiles.push_back(*find_profile(name));
    return profiles;
}

// Simpson over log r: independent of every closed form. Returns the integral of f(r) dr over [from, to].
double integrate(const std::function<double(double)>& f, double from, double to) {
    constexpr int kSteps = 4000;
    const double h = std::log(to / from) / kSteps;
    double sum = 0;
    for (int i = 0; i <= kSteps; ++i) {
        const double r = from * std::exp(h * i);
        sum += (i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2) * f(r) * r;
    }
    return sum * h / 3;
}

double ring_mm(double r) {
    return 2 * std::numbers::pi * r;
}

void expect_close(double value, double expected, double relative, const std::string& what) {
    EXPECT_NEAR(value, expected, relative * std::abs(expected)) << what;
}

}  // namespace

TEST(Profile, reflectance_integrates_to_the_albedo_and_the_cdf_to_one) {
    for (const Profile& profile : one_of_each())
        for (int c = 0; c < 3; ++c) {
            const double albedo = diffuse_albedo(profile, c);
            if (albedo == 0) continue;
            const auto light = [&](double r) { return ring_mm(r) * reflectance_per_mm2(profile, c, r); };
            const double far = 200 * mean_radius_mm(profile, c);
            const double tolerance = profile.model.index() == 3 ? 1e-4 : 1e-6;  // its kinks
            expect_close(integrate(light, 1e-9, far), albedo, tolerance, profile.name);
            EXPECT_NEAR(cdf(profile, c, far), 1, 1e-9) << profile.name;
            EXPECT_EQ(cdf(profile, c, 0), 0) << profile.name;
        }
}

TEST(Profile, cdf_and_moments_agree_with_quadrature_of_the_reflectance) {
    for (const Profile& profile : one_of_each())
        for (int c = 0; c < 3; ++c) {
            const double albedo = diffuse_albedo(profile, c);
            if (albedo == 0) continue;
            const double tolerance = profile.model.index() == 3 ? 1e-3 : 1e-6;
            const double mean = mean_radius_mm(profile, c), far = 300 * mean;
            const auto r_of = [&](double r) { return reflectance_per_mm2(profile, c, r) / albedo; };
            const auto moment = [&](int power, double to) {
                return integrate([&](double r) { return ring_mm(r) * std::pow(r, power) * r_of(r); }, 1e-9,
                                 to);
            };
            for (const double r : {0.1 * mean, mean, 3 * mean})
                EXPECT_NEAR(cdf(profile, c, r), moment(0, r), tolerance) << profile.name << " r " << r;
            expect_close(mean, moment(1, far), tolerance, profile.name);
            expect_close(mean_square_radius_mm2(profile, c), moment(2, far), tolerance, profile.name);
        }
}

TEST(Profile, inverse_cdf_undoes_the_cdf) {
    for (const Profile& profile : one_of_each())
        for (int c = 0; c < 3; ++c) {
            if (diffuse_albedo(profile, c) == 0) continue;
            for (const double u : {1e-9, 1e-4, 0.01, 0.3, 0.5, 0.9, 0.999, 0.999999})
                EXPECT_NEAR(cdf(profile, c, inverse_cdf_mm(profile, c, u)), u, 1e-12) << profile.name;
            EXPECT_EQ(inverse_cdf_mm(profile, c, 0), 0);
            EXPECT_EQ(inverse_cdf_mm(profile, c, -1), 0);
            EXPECT_GE(inverse_cdf_mm(profile, c, 1), inverse_cdf_mm(profile, c, 0.9999)) << profile.name;
        }
}

TEST(Profile, ten_times_the_lengths_scales_everything) {
    for (const Profile& profile : one_of_each()) {
        const Profile large = scaled(profile, 10);
        for (int c = 0; c < 3; ++c) {
            expect_close(diffuse_albedo(large, c), diffuse_albedo(profile, c), 1e-12, profile.name);
            expect_close(mean_radius_mm(large, c), 10 * mean_radius_mm(profile, c), 1e-12, profile.name);
            expect_close(inverse_cdf_mm(large, c, 0.7), 10 * inverse_cdf_mm(profile, c, 0.7), 1e-12,
                         profile.name);
            for (const double r : {0.05, 0.4, 1.9}) {
                EXPECT_NEAR(cdf(large, c, 10 * r), cdf(profile, c, r), 1e-12) << profile.name;
                expect_close(reflectance_per_mm2(large, c, 10 * r), reflectance_per_mm2(profile, c, r) / 100,
                             1e-9, profile.name);
            }
        }
    }
}

TEST(Profile, a_slab_lets_through_the_profile_at_the_straight_distance) {
    // d'Eon, Luebke 2007: integrate R(sqrt(r^2 + t^2)) over the far plane.
    for (const Profile& profile : one_of_each()) {
        if (profile.model.index() == 3) continue;
        for (const double t : {0.2, 1.0, 3.0}) {
            const auto light = [&](double r) {
                return ring_mm(r) * reflectance_per_mm2(profile, kRed, std::hypot(r, t));
            };
            const double expected = integrate(light, 1e-9, 200) / diffuse_albedo(profile, kRed);
            EXPECT_NEAR(slab_transmittance(profile, kRed, t), expected, 1e-6) << profile.name;
        }
    }
    const Profile gaussian{"one", "test", GaussianSum{"one", {{2.0, {1, 1, 1}}}}};
    EXPECT_NEAR(slab_transmittance(gaussian, kRed, 1.5), std::exp(-1.5 * 1.5 / 4), 1e-15);
}

TEST(Burley, radii_of_the_published_percentiles) {
    const Profile burley{"b", "test", BurleyProfile{}};
    EXPECT_NEAR(inverse_cdf_mm(burley, kRed, 0.5), 1.552, 5e-4);
    EXPECT_NEAR(inverse_cdf_mm(burley, kRed, 0.9), 6.062, 5e-4);
    EXPECT_NEAR(inverse_cdf_mm(burley, kRed, 0.99), 12.953, 5e-4);
    EXPECT_NEAR(inverse_cdf_mm(burley, kRed, 0.997), 16.564, 5e-4);
    EXPECT_DOUBLE_EQ(mean_radius_mm(burley, kRed), 2.5);
    EXPECT_DOUBLE_EQ(mean_square_radius_mm2(burley, kRed), 14);
}

TEST(Dipole, albedos_and_diffuse_mean_free_paths_of_the_skins_of_jensen) {
    const Rgb albedo[] = {{.4360, .2273, .1310}, {.6226, .4333, .3435}};
    const Rgb length_mm[] = {{3.6733, 1.3665, .6827}, {4.8215, 1.6937, 1.0900}};
    const Rgb d_mm[] = {{1.046, .389, .187}, {1.139, .482, .311}};
    const char* name[] = {"jensen_skin1", "jensen_skin2"};
    for (size_t skin = 0; skin < 2; ++skin)
        for (int c = 0; c < 3; ++c) {
            const Profile profile = *find_profile(name[skin]);
            const auto& medium = std::get<DipoleProfile>(profile.model).medium;
            const double length = diffuse_mean_free_path_mm(medium, c), a = diffuse_albedo(profile, c);
            EXPECT_NEAR(a, albedo[skin][size_t(c)], 5.1e-5) << name[skin] << c;
            EXPECT_NEAR(length, length_mm[skin][size_t(c)], 5.1e-5) << name[skin] << c;
            EXPECT_NEAR(length / diffuse_mean_free_path_per_d(a), d_mm[skin][size_t(c)], 5.1e-4)
                << name[skin];
        }
}

TEST(Presets, burley_d_of_the_published_table) {
    const auto expect_d = [](const char* name, const Rgb& d_mm, double tolerance) {
        const BurleyProfile burley = burley_equivalent(*find_profile(name));
        for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(burley.d_mm[c], d_mm[c], tolerance) << name << " " << c;
    };
    expect_d("gpu_gems_3", {.448, .104, .067}, 5.1e-4);
    expect_d("unreal_default", {.180, .068, .055}, 5.1e-4);
}

TEST(Presets, every_name_is_found_valid_and_says_where_it_is_from) {
    for (const std::string& name : profile_names()) {
        const Result<Profile> profile = find_profile(name);
        ASSERT_TRUE(profile) << name;
        EXPECT_EQ(profile->name, name);
        EXPECT_TRUE(check(*profile)) << name;
        EXPECT_FALSE(profile->source.empty()) << name;
    }
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(diffuse_albedo(*find_profile("gpu_gems_3"), c), 1, 1e-12) << "a pure blur kernel";
}

TEST(Presets, the_skins_of_openpbr_are_those_of_jensen_in_another_colour_space) {
    for (const auto& [openpbr, jensen] :
         {std::pair{"openpbr_skin_3", "jensen_skin2"}, std::pair{"openpbr_skin_4", "jensen_skin1"}})
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(diffuse_albedo(*find_profile(openpbr), c), diffuse_albedo(*find_profile(jensen), c),
                        1.1e-3);
}

TEST(Presets, an_unknown_name_proposes_the_closest) {
    EXPECT_THAT(find_profile("jensen_skin3").error().message, HasSubstr("did you mean 'jensen_skin"));
    EXPECT_THAT(find_profile("none.csv").error().message, HasSubstr("none.csv"));
}

TEST(Presets, burley_by_its_lengths) {
    const Result<Profile> profile = find_profile("burley:1,0.4,0.2");
    ASSERT_TRUE(profile);
    EXPECT_DOUBLE_EQ(mean_radius_mm(*profile, kBlue), 0.5);
    EXPECT_DOUBLE_EQ(mean_radius_mm(*find_profile("burley:2"), kGreen), 5);
    EXPECT_THAT(find_profile("burley:1,2").error().message, HasSubstr("one or three lengths"));
    EXPECT_THAT(find_profile("burley:1,x,2").error().message, HasSubstr("'x' is not a number"));
    EXPECT_THAT(find_profile("burley:0").error().message, HasSubstr("d_mm of red is 0"));
}

TEST(ProfileCheck, names_the_value_and_its_range) {
    const double nan = std::nan("");
    const auto message = [](auto model) {
        const Result<void> checked = check(Profile{"mine", "test", std::move(model)});
        return checked ? std::string("valid") : checked.error().message;
    };
    using Sum = GaussianSum;
    EXPECT_EQ(message(Sum{"s", {{1, {1, 1, 1}}}}), "valid");
    EXPECT_THAT(message(Sum{}), HasSubstr("profile 'mine': the sum of Gaussians is empty"));
    EXPECT_THAT(message(Sum{"s", {{-0.5, {1, 1, 1}}}}),
                HasSubstr("variance_mm2 of term 1 is -0.5; it must be 1e-12 to 1e12"));
    EXPECT_THAT(message(Sum{"s", {{nan, {1, 1, 1}}}}), HasSubstr("variance_mm2 of term 1 is nan"));
    EXPECT_THAT(message(Sum{"s", {{1, {1, nan, 1}}}}), HasSubstr("green weight of term 1 is nan"));
    EXPECT_THAT(message(Sum{"s", {{1, {1, 1, -2}}}}), HasSubstr("blue weight of term 1 is -2"));
    EXPECT_THAT(message(Sum{"s", {{1, {0, 0, 0}}}}), HasSubstr("all weights are 0"));
    EXPECT_THAT(message(BurleyProfile{.albedo = {1, 1.5, 1}}), HasSubstr("albedo of green is 1.5"));
    EXPECT_THAT(message(BurleyProfile{.d_mm = {1, 1, -1}}), HasSubstr("d_mm of blue is -1"));
    EXPECT_THAT(message(DipoleProfile{{.sigma_a_per_mm = {0, 1, 1}}}),
                HasSubstr("sigma_a_per_mm of red is 0"));
    EXPECT_THAT(message(DipoleProfile{{.eta = 0.5}}), HasSubstr("eta is 0.5; it must be 1 to 3"));
    EXPECT_THAT(message(DipoleProfile{{.g = 1}}), HasSubstr("g is 1"));
}

TEST(Profile, a_channel_without_reflectance_is_a_point) {
    const Profile profile = small_table();
    EXPECT_EQ(diffuse_albedo(profile, kBlue), 0);
    EXPECT_EQ(cdf(profile, kBlue, 0.5), 1);
    EXPECT_EQ(inverse_cdf_mm(profile, kBlue, 0.5), 0);
    EXPECT_EQ(mean_radius_mm(profile, kBlue), 0);
    EXPECT_EQ(slab_transmittance(profile, kBlue, 0.1), 0);
}
