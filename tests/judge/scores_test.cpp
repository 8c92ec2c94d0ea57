#include "dermis/judge/scores.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "dermis/image/resample.h"
#include "dermis/judge/report.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

constexpr int kScoredSide = 16;

Image even(float value, int channels) {
    Image image(kScoredSide, kScoredSide, channels);
    for (float& v : image.floats()) v = value;
    return image;
}

void set_pixel(Image& image, int x, int y, int channel, float value) {
    image.set(x, y, channel, value);
}

// Skin everywhere but in the first row; n.l falls from 1 to -1 from left to right; a shadow's edge in the
// fourth column.
SkinMasks masks() {
    Image light(kScoredSide, kScoredSide, 4), drawn = even(1, 1), skin = even(1, 1);
    for (int y = 0; y < kScoredSide; ++y)
        for (int x = 0; x < kScoredSide; ++x) {
            set_pixel(light, x, y, 2, 1 - 2 * float(x) / (kScoredSide - 1));
            set_pixel(light, x, y, 3, x == 3 || x == 8 ? 0.5f : 1.0f);
        }
    for (int x = 0; x < kScoredSide; ++x) set_pixel(skin, x, 0, 0, 0);
    return make_masks(light, drawn, skin);
}

double sum(const Image& mask) {
    double total = 0;
    for (const float v : mask.floats()) total += v;
    return total;
}

}  // namespace

TEST(Scores, masks_are_the_skin_its_terminator_and_the_edges_of_shadows) {
    const SkinMasks m = masks();
    EXPECT_EQ(sum(m.skin), kScoredSide * (kScoredSide - 1));
    // |1 - 2x/15| < 0.3 holds for x = 6..9.
    EXPECT_EQ(sum(m.terminator), 4 * (kScoredSide - 1));
    // Column 8 has a partial shadow too, but lies in the terminator.
    EXPECT_EQ(sum(m.penumbra), kScoredSide - 1);
    EXPECT_EQ(m.penumbra.at(3, 5, 0), 1);
}

TEST(Scores, pixels_that_only_one_renderer_calls_skin_do_not_count) {
    Image drawn = even(1, 1);
    set_pixel(drawn, 2, 2, 0, 0.75f);
    Image skin = even(1, 1);
    set_pixel(skin, 3, 3, 0, 0.5f);
    const SkinMasks m = make_masks(even(0, 4), drawn, skin);
    EXPECT_EQ(m.skin.at(2, 2, 0), 0);
    EXPECT_EQ(m.skin.at(3, 3, 0), 0);
    EXPECT_EQ(sum(m.skin), kScoredSide * kScoredSide - 2);
}

TEST(Scores, pixels_whose_points_are_all_skin_count_for_any_number_of_points) {
    for (int points_a_side = 1; points_a_side <= 20; ++points_a_side) {
        Image covered(kScoredSide * points_a_side, kScoredSide * points_a_side, 1);
        std::ranges::fill(covered.floats(), 1.0f);
        const SkinMasks m = make_masks(even(0, 4), resize(covered, kScoredSide, kScoredSide), even(1, 1));
        EXPECT_EQ(sum(m.skin), kScoredSide * kScoredSide) << points_a_side;
    }
}

TEST(Scores, an_error_counts_where_it_is_and_nowhere_else) {
    const Image reference = even(0.25f, 4);
    Image radiance = reference;
    for (int y = 1; y < kScoredSide; ++y)
        for (int c = 0; c < 3; ++c) set_pixel(radiance, 3, y, c, 0.35f);
    for (int x = 0; x < kScoredSide; ++x) set_pixel(radiance, x, 0, 0, 100);  // not skin
    const auto scores = score(radiance, reference, masks(), {});
    ASSERT_TRUE(scores) << scores.error().message;
    EXPECT_NEAR(*scores->penumbra_rmse, 0.1, 1e-6);
    EXPECT_EQ(*scores->terminator_rmse, 0);
    EXPECT_NEAR(scores->rmse, 0.1 / 4, 1e-6);
    EXPECT_GT(scores->flip, 0);
    EXPECT_LT(scores->ssim, 1);
}

TEST(Scores, of_the_reference_itself_are_perfect) {
    const Image reference = even(0.25f, 4);
    const auto scores = score(reference, reference, masks(), {});
    ASSERT_TRUE(scores);
    EXPECT_EQ(scores->rmse, 0);
    EXPECT_EQ(scores->flip, 0);
    EXPECT_EQ(scores->ssim, 1);
    EXPECT_TRUE(std::isinf(scores->psnr_db));
}

TEST(Scores, nan_and_other_sizes_are_refused) {
    const Image reference = even(0.25f, 4);
    Image radiance = reference;
    set_pixel(radiance, 5, 5, 1, std::numeric_limits<float>::quiet_NaN());
    EXPECT_FALSE(score(radiance, reference, masks(), {}));
    const auto sizes = score(Image(8, 8, 4), reference, masks(), {});
    ASSERT_FALSE(sizes);
    EXPECT_THAT(sizes.error().message, HasSubstr("8x8"));
}

TEST(Scores, the_table_has_the_stated_columns_and_quotes_settings) {
    ScoreRow row{
        .scene = "head, scanned", .technique = "wrap", .settings = "wrap=0.4,specular=ggx", .bytes = 7};
    row.surface.emplace().all = {.share = 0.25, .error = 0.01, .effect_rms = 0.5, .reference_noise = 0.125};
    row.surface->channels[1].error = 1;  // too noisy to tell
    row.scores.terminator_rmse = 0.125;
    row.scores.psnr_db = std::numeric_limits<double>::infinity();
    EXPECT_EQ(
        scores_csv({row}),
        "scene,technique,settings,walk_captured,walk_captured_r,walk_captured_g,walk_captured_b,"
        "walk_captured_error,walk_effect_rms,walk_reference_noise,captured,captured_r,captured_g,captured_b,"
        "captured_error,effect_rms,"
        "reference_noise,rmse,rel_mse,psnr_db,ssim,delta_e_2000,flip,terminator_rmse,penumbra_rmse,time_ms,"
        "bytes,time_ratio,reference_rmse,model_ratio,walk_motion,walk_motion_error,motion,motion_error\n"
        "\"head, "
        "scanned\",wrap,\"wrap=0.4,specular=ggx\",,,,,,,,0.25,0,,0,0.01,0.5,0.125,0,0,inf,0,0,0,0.125,"
        ",0,7,0,0,,,,,\n");
}

TEST(Scores, a_table_of_an_earlier_version_is_read) {
    ScoreRow row{.scene = "spheres", .technique = "wrap"};
    row.surface.emplace().all = {.share = 0.25, .error = 0.01, .effect_rms = 0.5, .reference_noise = 0.125};
    // Earlier versions had one reference and another name for its noise.
    std::string text = scores_csv({row});
    const std::string walk =
        "walk_captured,walk_captured_r,walk_captured_g,walk_captured_b,walk_captured_error,walk_effect_rms,"
        "walk_reference_noise,";
    text.erase(text.find(walk), walk.size());
    text.replace(text.find(",reference_noise"), 16, ",truth_noise");
    text.erase(text.find("wrap,") + 6, 7);
    const auto rows = parse_scores(text);
    ASSERT_TRUE(rows) << rows.error().message << "\n" << text;
    EXPECT_EQ(rows->at(0).surface->all.reference_noise, 0.125);
    EXPECT_EQ(rows->at(0).surface->all.share, 0.25);
    EXPECT_FALSE(rows->at(0).walk);
}

TEST(Scores, the_shares_of_both_references_are_read_back) {
    ScoreRow row{.scene = "spheres", .technique = "wrap"};
    row.walk.emplace().all = {.share = 0.125, .error = 0.01, .effect_rms = 0.5, .reference_noise = 0.125};
    row.walk->channels[2].error = 1;  // too noisy to tell
    const auto one = parse_scores(scores_csv({row}));
    ASSERT_TRUE(one) << one.error().message;
    EXPECT_FALSE(one->at(0).surface) << "it was not made";
    row.surface.emplace().all = {.share = 0.75, .error = 0.02, .effect_rms = 0.25, .reference_noise = 0.25};
    const auto both = parse_scores(scores_csv({row}));
    ASSERT_TRUE(both) << both.error().message;
    EXPECT_EQ(both->at(0).walk->all.share, 0.125);
    EXPECT_FALSE(both->at(0).walk->channels[2].known());
    EXPECT_EQ(both->at(0).surface->all.share, 0.75);
    EXPECT_EQ(both->at(0).surface->all.error, 0.02);
    EXPECT_EQ(headline(both->at(0)).all.share, 0.125) << "walk decides";
}

TEST(HeatMap, lightness_rises_with_the_value_and_what_is_outside_is_grey) {
    float before = -1;
    for (int i = 0; i <= 20; ++i) {
        const Vec3 c = heat_color(float(i) / 20);
        const float light = 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
        EXPECT_GT(light, before);
        before = light;
    }
    Image mask = even(1, 1);
    mask.set(0, 0, 0, 0);
    const Image picture = heat_map(even(2, 1), 1, mask);
    EXPECT_EQ(picture.values<uint8_t>()[0], picture.values<uint8_t>()[1]);
    EXPECT_NEAR(picture.at(1, 0, 0), heat_color(1).x, 1.0 / 255);
}
