#include "dermis/view/quality.h"

#include <gtest/gtest.h>

namespace dermis::view {
namespace {

constexpr QualityLimits kLimits;

// A drawing of one megapixel, and at once its time.
void drawn(QualityLadder& ladder, Quality quality, double time_ms) {
    ladder.drawn(quality);
    ladder.measured(quality, 1, time_ms);
}

TEST(Quality, a_slow_device_draws_coarsely_while_moving_then_whole_then_finely_then_nothing) {
    QualityLadder ladder(800);
    const auto moving = ladder.due(true, 0, 1, kLimits);
    ASSERT_TRUE(moving);
    EXPECT_EQ(moving->scale, 0.25f);
    EXPECT_EQ(moving->samples, 1);
    drawn(ladder, *moving, 50);
    EXPECT_EQ(ladder.due(false, 0.1, 1, kLimits), Quality{});
    drawn(ladder, Quality{}, 800);
    EXPECT_FALSE(ladder.due(false, 0.2, 1, kLimits));
    EXPECT_FALSE(ladder.is_final(kLimits));
    EXPECT_EQ(ladder.due(false, 1, 1, kLimits), (Quality{.samples = 4}));
    drawn(ladder, {.samples = 4}, 2400);
    EXPECT_TRUE(ladder.is_final(kLimits));
    EXPECT_FALSE(ladder.due(false, 9, 1, kLimits));
}

TEST(Quality, a_fast_device_draws_finely_at_once) {
    const QualityLadder ladder(2);
    EXPECT_EQ(ladder.due(true, 0, 1, kLimits), (Quality{.samples = 4}));
}

TEST(Quality, the_scale_follows_what_was_measured) {
    QualityLadder ladder(800);
    for (int i = 0; i < 12; ++i) drawn(ladder, Quality{}, 40);
    EXPECT_EQ(ladder.due(true, 0, 1, kLimits), Quality{});
    for (int i = 0; i < 12; ++i) drawn(ladder, {.scale = 0.5f}, 100);
    EXPECT_EQ(ladder.due(true, 0, 1, kLimits), (Quality{.scale = 0.25f}));
}

TEST(Quality, one_sample_is_enough_where_the_device_has_no_more) {
    QualityLadder ladder(100);
    const QualityLimits limits{.samples = 1};
    drawn(ladder, Quality{}, 100);
    EXPECT_TRUE(ladder.is_final(limits));
}

}  // namespace
}  // namespace dermis::view
