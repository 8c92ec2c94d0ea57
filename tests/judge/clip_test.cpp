// Shares over the frames of a clip.

#include "dermis/judge/clip_motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace dermis;
using testing::HasSubstr;
using testing::Not;

namespace {

Captured clip_captured(double share, double error) {
    Captured captured;
    captured.all = {.share = share, .error = error, .effect_rms = 0.02, .reference_noise = 0.001};
    return captured;
}

ScoreRow clip_row(const std::string& settings, double share, std::optional<ShareChange> change = {}) {
    return {.technique = "wrap",
            .settings = settings,
            .walk = clip_captured(share, 0.03),
            .surface = {},
            .scores = {},
            .walk_change = change};
}

// In the first frame the rest pose's gain changes nothing, so that it has no row.
std::vector<ClipFrame> two_frames() {
    return {{0.5, {clip_row("gain=map", 0.6)}},
            {1.5, {clip_row("gain=map", 0.4), clip_row("gain=map,rest=gain", 0.3, ShareChange{-0.1, 0.02})}}};
}

}  // namespace

TEST(Clip, has_mean_and_worst_of_its_frames) {
    const auto share = clip_share(two_frames(), {"wrap", "gain=map"}, Integrator::walk);
    ASSERT_TRUE(share);
    EXPECT_DOUBLE_EQ(share->mean, 0.5);
    EXPECT_DOUBLE_EQ(share->error, 0.03 / std::sqrt(2.0));
    EXPECT_EQ(share->worst, 0.4);
    EXPECT_EQ(share->worst_time_s, 1.5);
    EXPECT_FALSE(share->change);
    EXPECT_FALSE(clip_share(two_frames(), {"wrap", "gain=map"}, Integrator::surface));
}

TEST(Clip, takes_a_row_that_a_frame_lacks_as_unchanged) {
    const auto share = clip_share(two_frames(), {"wrap", "gain=map,rest=gain"}, Integrator::walk);
    ASSERT_TRUE(share && share->change);
    EXPECT_DOUBLE_EQ(share->mean, 0.45);
    EXPECT_DOUBLE_EQ(share->change->change, -0.05);
    EXPECT_DOUBLE_EQ(share->change->error, 0.01);
    EXPECT_DOUBLE_EQ(share->worst_change, -0.1);
    std::vector<ClipFrame> second = {two_frames()[1]};
    second[0].rows[1].walk_change->change = 0.2;
    EXPECT_DOUBLE_EQ(clip_share(second, {"wrap", "gain=map,rest=gain"}, Integrator::walk)->worst_change, 0.2);
    EXPECT_EQ(clip_rows(two_frames()).size(), 2u);
}

TEST(Clip, has_no_worst_frame_where_all_are_noise) {
    std::vector<ClipFrame> frames = two_frames();
    for (ClipFrame& frame : frames) frame.rows[0].walk->all.error = 1;
    const auto share = clip_share(frames, {"wrap", "gain=map"}, Integrator::walk);
    ASSERT_TRUE(share);
    EXPECT_TRUE(std::isnan(share->worst));
    EXPECT_THAT(clip_csv(frames), HasSubstr("wrap,\"gain=map\",walk,2,0.5000,0.7071,,"));
}

TEST(Clip, share_of_the_motion_is_that_of_the_differences_between_frames) {
    const auto picture = [](float first, float second) {
        Image image(2, 1, 3);
        for (int c = 0; c < 3; ++c) image.floats()[c] = first, image.floats()[3 + c] = second;
        return image;
    };
    const auto frame = [&](float reference, float technique) {
        ClipEffects effects{.references = {EffectHalves{picture(reference, 9), picture(reference, 9)}, {}},
                            .skin = Image(2, 1, 1)};
        effects.skin.floats()[0] = 1;
        effects.rows = {{{"wrap", ""}, {picture(technique, 5), {}}}, {{"lambert", ""}, {picture(0, 0), {}}}};
        return effects;
    };
    // Off by 3 in both frames, it moves as the reference does; then it moves half as far.
    std::vector<ScoreRow> rows(2);
    ASSERT_TRUE(set_motion_shares(frame(1, 4), frame(2, 5), rows));
    EXPECT_DOUBLE_EQ(rows[0].walk_motion->all.share, 1);
    EXPECT_DOUBLE_EQ(rows[1].walk_motion->all.share, 0);
    EXPECT_FALSE(rows[0].surface_motion);
    std::vector<ScoreRow> half(2);
    ASSERT_TRUE(set_motion_shares(frame(2, 5), frame(4, 6), half));
    EXPECT_DOUBLE_EQ(half[0].walk_motion->all.share, 0.5);

    std::vector<ClipFrame> frames = {
        {0, {clip_row("", 0.5)}}, {1, {clip_row("", 0.5)}}, {2, {clip_row("", 0.5)}}};
    EXPECT_FALSE(clip_share(frames, {"wrap", ""}, Integrator::walk)->motion);
    frames[1].rows[0].walk_motion = rows[0].walk_motion;
    frames[2].rows[0].walk_motion = half[0].walk_motion;
    const auto share = clip_share(frames, {"wrap", ""}, Integrator::walk);
    ASSERT_TRUE(share && share->motion);
    // |T - S|^2 of both pairs is 0 and 1, |S|^2 1 and 4.
    EXPECT_NEAR(*share->motion, 1 - std::sqrt(1.0 / 5), 1e-6);
    const std::vector<ScoreRow> whole = rows_of_clip("head talk", frames);
    ASSERT_EQ(whole.size(), 1u);
    EXPECT_EQ(whole[0].scene, "head talk");
    EXPECT_DOUBLE_EQ(whole[0].walk->all.share, 0.5);
    EXPECT_DOUBLE_EQ(whole[0].walk->all.error, 0.03 / std::sqrt(3.0));
    EXPECT_EQ(whole[0].walk_motion->all.share, *share->motion);
    EXPECT_FALSE(whole[0].surface_motion);
}

TEST(Clip, page_links_each_frame_and_escapes_text) {
    const std::string links[] = {"frame_00/report.html", "frame_01/report.html"};
    const std::string page = clip_html("<head>", "a & b", two_frames(), links);
    for (const char* text :
         {"&lt;head&gt;", "a &amp; b", "<a href=\"frame_01/report.html\">1.50 s</a>", "-0.0500"})
        EXPECT_THAT(page, HasSubstr(text));
    EXPECT_THAT(page, Not(HasSubstr("<head>,")));
}
