#include "dermis/image/tone_map.h"

#include <gtest/gtest.h>

#include <limits>

using namespace dermis;

namespace {

constexpr ToneMap kCurves[] = {ToneMap::none, ToneMap::hable, ToneMap::aces, ToneMap::pbr_neutral};

Vec3 grey(float x) {
    return {x, x, x};
}

}  // namespace

TEST(ToneMap, black_stays_black) {
    for (const ToneMap curve : kCurves) EXPECT_EQ(tone_map(curve, Vec3{}), Vec3{});
}

TEST(ToneMap, curves_rise_and_stay_within_0_and_1) {
    for (const ToneMap curve : kCurves) {
        float before = 0;
        for (float x = 1e-4f; x < 1e6f; x *= 1.05f) {
            const Vec3 c = tone_map(curve, grey(x));
            EXPECT_GE(c.x, before - 1e-6f) << int(curve) << " at " << x;
            EXPECT_LE(c.x, 1.0f);
            before = c.x;
        }
        EXPECT_GT(before, 0.99f);
    }
}

TEST(ToneMap, grey_stays_grey) {
    for (const ToneMap curve : kCurves)
        for (const float x : {0.05f, 0.18f, 0.5f, 1.0f, 4.0f}) {
            const Vec3 c = tone_map(curve, grey(x));
            EXPECT_NEAR(c.x, c.y, 2e-4f);
            EXPECT_NEAR(c.y, c.z, 2e-4f);
        }
}

// Worked by hand from the formulas.
TEST(ToneMap, curves_have_their_published_values) {
    EXPECT_NEAR(tone_map(ToneMap::hable, grey(5.6f)).x, 1.0f, 1e-6f);  // the white point, half of 11.2
    // f(2) = (2 (0.3 + 0.05) + 0.004) / (2 (0.3 + 0.5) + 0.06) - 1/15 = 0.357430, f(11.2) = 0.724956
    EXPECT_NEAR(tone_map(ToneMap::hable, grey(1.0f)).x, 0.493040f, 2e-4f);
    EXPECT_NEAR(tone_map(ToneMap::aces, grey(1.0f)).x, 1.024488f / 1.654761f, 1e-3f);
    EXPECT_EQ(tone_map(ToneMap::none, grey(0.3f)).x, 0.3f);
}

TEST(ToneMap, neutral_keeps_base_colours_less_the_fresnel_offset_and_compresses_above) {
    const Vec3 skin = tone_map(ToneMap::pbr_neutral, Vec3{0.6f, 0.4f, 0.3f});
    EXPECT_NEAR(skin.x, 0.56f, 1e-6f);
    EXPECT_NEAR(skin.y, 0.36f, 1e-6f);
    EXPECT_NEAR(skin.z, 0.26f, 1e-6f);
    EXPECT_NEAR(tone_map(ToneMap::pbr_neutral, grey(0.04f)).x, 6.25f * 0.04f * 0.04f, 1e-6f);
    // Grey 1: less 0.04, peak 0.96 becomes 1 - 0.24^2 / (0.96 + 0.24 - 0.76).
    EXPECT_NEAR(tone_map(ToneMap::pbr_neutral, grey(1.0f)).x, 1.0f - 0.0576f / 0.44f, 1e-6f);
    // The slope is continuous where compression starts.
    const auto at = [](float x) { return tone_map(ToneMap::pbr_neutral, grey(x)).x; };
    EXPECT_NEAR((at(0.801f) - at(0.8f)) / 0.001f, (at(0.799f) - at(0.798f)) / 0.001f, 0.02f);
    // A bright saturated red goes towards white: peak 1 - 0.0576 / 19.48, share 1 - 1 / (0.15 * 19.003 + 1).
    EXPECT_NEAR(tone_map(ToneMap::pbr_neutral, Vec3{20.0f, 0.0f, 0.0f}).y, 0.738100f, 1e-4f);
}

TEST(ToneMap, negative_infinite_and_undefined_light_gives_a_displayable_colour) {
    for (const ToneMap curve : kCurves)
        for (const float x : {-1.0f, HUGE_VALF, std::numeric_limits<float>::quiet_NaN()}) {
            const Vec3 c = tone_map(curve, Vec3{x, 0.2f, x});
            for (const float value : {c.x, c.y, c.z})
                EXPECT_TRUE(value >= 0.0f && value <= 1.0f) << int(curve);
        }
}

TEST(ToneMap, a_picture_is_exposed_first_and_alpha_passes) {
    Image image(3, 2, 4);
    for (int c = 0; c < 4; ++c) image.set(1, 1, c, 0.2f + 0.1f * float(c));
    const Image out = tone_mapped(image, ToneMap::hable, 2.0f);
    const Vec3 expected = tone_map(ToneMap::hable, Vec3{0.4f, 0.6f, 0.8f});
    EXPECT_FLOAT_EQ(out.at(1, 1, 0), expected.x);
    EXPECT_FLOAT_EQ(out.at(1, 1, 2), expected.z);
    EXPECT_FLOAT_EQ(out.at(1, 1, 3), 0.5f);
}

TEST(ToneMap, names_parse_and_unknown_ones_propose) {
    for (const ToneMap curve : kCurves) EXPECT_EQ(*parse_tone_map(tone_map_names()[size_t(curve)]), curve);
    EXPECT_NE(parse_tone_map("pbr_neutrl").error().message.find("did you mean 'pbr_neutral'"),
              std::string::npos);
}
