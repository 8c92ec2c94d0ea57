#include "dermis/optics/tissue/skin_model.h"

#include <gtest/gtest.h>

#include "dermis/image/colour.h"
#include "dermis/optics/conversions.h"
#include "dermis/optics/presets.h"
#include "layered_walk.h"

namespace dermis {
namespace {

using tissue::kWavelengths;
using tissue::layered_albedo;
using tissue::TissueLayer;

int index_of(double nm) {
    return int((nm - tissue::kFirstNm) / tissue::kStepNm);
}

struct Walked {
    Rgb albedo = {}, radius_mm = {};
};

Walked walked(const SkinModel& model, int walks) {
    Walked sum;
    Rgb light = {};
    for (int i = 0; i < kWavelengths; ++i) {
        const SkinLayers layers = skin_layers(model, i);
        LayeredWalk walk({{layers.epidermis.sigma_s_per_mm, layers.epidermis.sigma_a_per_mm},
                          {layers.dermis.sigma_s_per_mm, layers.dermis.sigma_a_per_mm},
                          model.epidermis_mm,
                          model.eta,
                          model.g},
                         unsigned(i + 1));
        double returned = 0, at_mm = 0;
        for (int n = 0; n < walks; ++n) {
            const WalkReturn end = walk.one();
            returned += end.light / walks;
            at_mm += end.light * end.radius_mm / walks;
        }
        for (size_t c = 0; c < 3; ++c) {
            const double share = tissue::linear_weights()[size_t(i)][c], seen = std::max(0.0, share);
            sum.albedo[c] += share * returned;
            light[c] += seen * returned;
            sum.radius_mm[c] += seen * at_mm;
        }
    }
    for (size_t c = 0; c < 3; ++c) sum.radius_mm[c] /= light[c];
    return sum;
}

Vec3 lab_of(const Rgb& c) {
    return lab_from_linear({float(c[0]), float(c[1]), float(c[2])});
}

TEST(SkinModel, has_the_albedo_and_the_mean_radius_of_walks_through_its_layers) {
    constexpr int kWalks = 300;  // a standard error of 0.003
    const SkinModel models[] = {{.melanin = 0, .blood = 0.002},
                                {.melanin = 0.05, .blood = 0.1},
                                {.melanin = 0.43, .blood = 0.02},
                                {.melanin = 0.02, .blood = 0.02, .epidermis_mm = 0.12},
                                {.melanin = 0.12, .blood = 0.002, .epidermis_mm = 0.12},
                                {.melanin = 0.43, .blood = 0.1, .epidermis_mm = 0.12}};
    for (const SkinModel& model : models) {
        const Walked walks = walked(model, kWalks);
        const Rgb albedo = skin_albedo(model), radius_mm = skin_mean_radius_mm(model);
        for (size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(albedo[c], walks.albedo[c], 0.015) << skin_model_text(model) << " " << c;
            EXPECT_NEAR(radius_mm[c], walks.radius_mm[c], 0.02 + 0.15 * walks.radius_mm[c])
                << skin_model_text(model) << " " << c;
        }
    }
}

// Groups of the typology angle, "123456", that melanin .01 to .43 reaches; empty where the angle does not
// fall.
std::string groups_of_melanin(double blood, double epidermis_mm) {
    // Del Bino, Bernerd 2013.
    const double borders_deg[] = {90, 55, 41, 28, 10, -30, -90};
    double last_deg = 90;
    std::string groups;
    for (double melanin = 0.01; melanin < 0.431; melanin += 0.005) {
        const double angle_deg = typology_angle_deg(
            skin_albedo({.melanin = melanin, .blood = blood, .epidermis_mm = epidermis_mm}));
        if (angle_deg >= last_deg) return "";
        last_deg = angle_deg;
        for (size_t group = 0; group < 6; ++group)
            if (const char name = char('1' + group); angle_deg < borders_deg[group] &&
                                                     angle_deg >= borders_deg[group + 1] &&
                                                     groups.find(name) == groups.npos)
                groups += name;
    }
    return groups;
}

TEST(SkinModel, melanin_alone_covers_the_groups_of_the_typology_angle_in_order) {
    // Blood .002: the mean of the skin (Jacques 1998), where the angle is measured.
    EXPECT_EQ(groups_of_melanin(0.002, 0.06), "123456");
    EXPECT_EQ(groups_of_melanin(0.002, 0.1), "123456");
}

TEST(SkinModel, blood_of_a_face_lowers_the_typology_angle_and_keeps_its_order) {
    for (const double epidermis_mm : {0.06, 0.1}) {
        EXPECT_EQ(groups_of_melanin(0.005, epidermis_mm), "23456");
        EXPECT_EQ(groups_of_melanin(0.01, epidermis_mm), "23456");
        EXPECT_EQ(groups_of_melanin(0.015, epidermis_mm), "23456");
        EXPECT_EQ(groups_of_melanin(0.02, epidermis_mm), "3456");
    }
}

TEST(SkinModel, six_tones_lie_in_the_six_groups_and_are_profiles) {
    const double borders_deg[] = {90, 55, 41, 28, 10, -30, -90};
    for (int tone = 1; tone <= 6; ++tone) {
        const Result<SkinModel> model = parse_skin_model("skin:tone=" + std::to_string(tone));
        ASSERT_TRUE(model);
        EXPECT_EQ(*model, skin_model_of_tone(tone));
        const double angle_deg = typology_angle_deg(skin_albedo(*model));
        EXPECT_LT(angle_deg, borders_deg[tone - 1]) << tone;
        EXPECT_GT(angle_deg, borders_deg[tone]) << tone;
    }
    EXPECT_EQ(parse_skin_model("skin:tone=3,blood=0.05")->melanin, skin_model_of_tone(3).melanin);
    EXPECT_FALSE(parse_skin_model("skin:tone=7"));
    EXPECT_FALSE(parse_skin_model("skin:blood=0.05,tone=3"));
}

TEST(SkinModel, oxygenated_blood_draws_a_w_between_540_and_580_nm_and_deoxygenated_has_none) {
    const auto at = [](const SkinSpectrum& spectrum, double nm) { return spectrum[size_t(index_of(nm))]; };
    const SkinSpectrum with = skin_spectrum({.blood = 0.03, .oxygen = 1});
    EXPECT_GT(at(with, 560), at(with, 540) + 0.01);
    EXPECT_GT(at(with, 560), at(with, 575) + 0.01);
    EXPECT_GT(at(with, 525), at(with, 540));
    EXPECT_GT(at(with, 590), at(with, 575));
    const SkinSpectrum without = skin_spectrum({.blood = 0.03, .oxygen = 0});
    int peaks = 0;
    for (int i = index_of(535); i <= index_of(580); ++i)
        peaks += without[size_t(i)] > without[size_t(i - 1)] && without[size_t(i)] > without[size_t(i + 1)];
    EXPECT_EQ(peaks, 0);
    EXPECT_LT(at(without, 555), at(without, 530));
    EXPECT_LT(at(without, 555), at(without, 580));
}

TEST(SkinModel, more_melanin_is_darker_and_narrower_in_every_channel) {
    for (const double blood : {0.002, 0.03, 0.1}) {
        Rgb albedo = {1, 1, 1}, radius_mm = {9, 9, 9};
        for (const double melanin : {0.0, 0.01, 0.04, 0.12, 0.25, 0.43}) {
            const SkinModel model{.melanin = melanin, .blood = blood};
            const Rgb next = skin_albedo(model), next_mm = skin_mean_radius_mm(model);
            for (size_t c = 0; c < 3; ++c) {
                EXPECT_LT(next[c], albedo[c]) << melanin;
                EXPECT_LT(next_mm[c], radius_mm[c]) << melanin;
            }
            albedo = next, radius_mm = next_mm;
        }
    }
}

TEST(SkinModel, more_blood_is_redder) {
    for (const double melanin : {0.0, 0.03, 0.12, 0.43}) {
        double share = 0, green = 1;
        for (const double blood : {0.0, 0.005, 0.02, 0.05, 0.1}) {
            const Rgb albedo = skin_albedo({.melanin = melanin, .blood = blood});
            EXPECT_GT(albedo[0] / albedo[1], share) << melanin << " " << blood;
            EXPECT_LT(albedo[1], green);
            share = albedo[0] / albedo[1], green = albedo[1];
        }
    }
    EXPECT_GT(lab_of(skin_albedo({.blood = 0.04})).y, lab_of(skin_albedo({.blood = 0.01})).y + 5);
}

TEST(SkinModel, pheomelanin_is_redder_than_eumelanin_and_blood_without_oxygen_bluer) {
    const Rgb eumelanin = skin_albedo({.melanin = 0.1});
    const Rgb pheomelanin = skin_albedo({.melanin = 0.1, .pheomelanin = 1});
    EXPECT_GT(pheomelanin[0] / pheomelanin[2], eumelanin[0] / eumelanin[2]);
    const Rgb pale = skin_albedo({.blood = 0.05, .oxygen = 0.2}),
              full = skin_albedo({.blood = 0.05, .oxygen = 1});
    EXPECT_LT(lab_of(pale).y, lab_of(full).y - 2);
}

TEST(LayeredAlbedo, does_not_see_a_border_between_equal_layers) {
    const TissueLayer layer{4, 0.5};
    const double whole = layered_albedo(layer, 0, layer, 0.8, 1.4);
    for (const double thickness_mm : {0.001, 0.06, 0.5, 5.0})
        EXPECT_NEAR(layered_albedo(layer, thickness_mm, layer, 0.8, 1.4), whole, 2e-3) << thickness_mm;
}

TEST(LayeredAlbedo, is_that_of_van_de_hulst_without_a_boundary_and_1_without_absorption) {
    for (const double albedo : {0.3, 0.7, 0.9, 0.99}) {
        const TissueLayer layer{albedo, 1 - albedo};
        EXPECT_NEAR(layered_albedo(layer, 0, layer, 0, 1), multiscatter_albedo(albedo, 0), 0.012) << albedo;
    }
    EXPECT_NEAR(layered_albedo({4, 0}, 0.1, {4, 0}, 0.8, 1.4), 1, 0.01);
}

TEST(SkinSpectra, a_white_surface_is_white_and_the_observer_sees_d65_where_it_is) {
    SkinSpectrum white;
    white.fill(1);
    for (const double channel : linear_of_spectrum(white)) EXPECT_NEAR(channel, 1, 1e-5);
    // The luminous efficiency peaks at 1 at 555 nm.
    EXPECT_NEAR(tissue::observer_xyz(555)[1], 1, 0.01);
    EXPECT_NEAR(tissue::observer_xyz(600)[0], 1.0622, 0.02);
    EXPECT_NEAR(tissue::observer_xyz(445)[2], 1.7826, 0.04);
}

TEST(SkinModel, is_a_profile_by_its_text) {
    const SkinModel model{.melanin = 0.05, .blood = 0.03};
    EXPECT_EQ(skin_model_text(model), "skin:melanin=0.05,blood=0.03");
    const Result<SkinModel> read = parse_skin_model(skin_model_text(model));
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, model);
    const Result<Profile> profile = find_profile(skin_model_text(model));
    ASSERT_TRUE(profile);
    ASSERT_TRUE(check(*profile));
    const ScatteringMedium volume = walk_medium_of(*profile);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(diffuse_albedo(*profile, c), skin_albedo(model)[size_t(c)], 1e-9);
        EXPECT_NEAR(mean_radius_mm(*profile, c), skin_mean_radius_mm(model)[size_t(c)], 1e-9);
        EXPECT_NEAR(multiscatter_albedo(single_scatter_albedo(volume, c), 0), diffuse_albedo(*profile, c),
                    1e-3);
    }
}

TEST(SkinModel, refuses_bad_input_in_one_line) {
    const auto message = [](const char* text) {
        const Result<Profile> profile = find_profile(text);
        return profile ? std::string("accepted") : profile.error().message;
    };
    EXPECT_EQ(message("skin:melanin=1.5"), "skin model: melanin is 1.5; it must be 0 to 1");
    EXPECT_EQ(message("skin:blood=-0.1"), "skin model: blood is -0.1; it must be 0 to 1");
    EXPECT_EQ(message("skin:oxygen=nan"), "skin model: oxygen is nan; it must be 0 to 1");
    EXPECT_EQ(message("skin:scattering_per_mm=0"),
              "skin model: scattering_per_mm is 0; it must be 0.1 to 100");
    EXPECT_NE(message("skin:melanine=0.1").find("did you mean 'melanin'?"), std::string::npos);
    EXPECT_NE(message("skin:melanin").find("needs a number"), std::string::npos);
}

}  // namespace
}  // namespace dermis
