#include "dermis/image/colour.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dermis {
namespace {

constexpr float kDegrees = 57.2957795f;

Vec3 lab_of(double tone) {
    return lab_from_linear(skin_tone_albedo_linear(tone));
}

TEST(SkinColour, grows_strictly_darker_from_tone_1_to_6) {
    float last = 1;
    for (int i = 0; i <= 40; ++i) {
        const Vec3 c = skin_tone_albedo_linear(1 + i / 8.0);
        ASSERT_LT(luminance(c), last) << 1 + i / 8.0;
        ASSERT_GT(std::min({c.x, c.y, c.z}), 0.01f);
        last = luminance(c);
    }
}

TEST(SkinColour, keeps_the_hue_of_skin_at_every_tone) {
    for (int i = 0; i <= 40; ++i) {
        const double tone = 1 + i / 8.0;
        const Vec3 c = skin_tone_albedo_linear(tone), lab = lab_of(tone);
        // Between the pink of fair and the brown of dark faces; olive begins beyond 65 degrees.
        const float hue_deg = std::atan2(lab.z, lab.y) * kDegrees, chroma = std::hypot(lab.y, lab.z);
        ASSERT_GT(hue_deg, 42) << tone;
        ASSERT_LT(hue_deg, 56) << tone;
        ASSERT_GT(chroma, 15) << tone;
        ASSERT_LT(chroma, 26) << tone;
        ASSERT_GT(c.x / c.y, 1.4f) << tone;
        ASSERT_GT(c.y / c.z, 1.1f) << tone;
    }
}

TEST(SkinColour, spans_the_classes_of_the_individual_typology_angle_one_each) {
    // Chardon et al. 1991; Del Bino and Bernerd 2013: very light above 55 degrees, light to 41, intermediate
    // to 28, tan to 10, brown to -30, dark. Tone III is on the border of light and intermediate.
    const float borders_deg[] = {90, 55, 41, 28, 10, -30, -90};
    for (int tone = 1; tone <= 6; ++tone) {
        const Vec3 lab = lab_of(tone);
        const float ita_deg = std::atan((lab.x - 50) / lab.z) * kDegrees;
        const int group = tone <= 2 ? 0 : tone == 3 ? 2 : tone - 1;
        EXPECT_LT(ita_deg, borders_deg[group] + 0.5f) << tone << ": " << ita_deg;
        EXPECT_GT(ita_deg, borders_deg[group + 1] - 0.5f) << tone << ": " << ita_deg;
    }
}

TEST(SkinColour, has_the_lightness_of_openpbr_for_the_three_dark_tones) {
    const Vec3 examples[] = {{.351f, .240f, .148f}, {.227f, .157f, .091f}, {.073f, .052f, .025f}};
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(lab_of(4 + i).x, lab_from_linear(kLinearFromAcesCg * examples[i]).x, 0.1f);
}

}  // namespace
}  // namespace dermis
