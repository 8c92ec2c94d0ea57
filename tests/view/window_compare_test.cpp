// Two pictures beside each other, and the same head in another skin.

#include <gmock/gmock.h>

#include <cmath>

#include "view/window_fixture.h"

namespace dermis {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

}  // namespace

TEST_F(ViewWindow, two_techniques_and_a_picture_are_shown_side_by_side) {
    const ProgramResult result = view(square() + " --size 560x320 --samples 1 -t lambert", R"(
        screenshot DIR/left.png
        key C
        key X
        key T
        key X
        settle
        capture DIR/wipe.png
        drag left 140 100 60 100
        settle
        capture DIR/wiped.png
        key C
        settle
        capture DIR/beside.png
        drop DIR/left.png
        settle
        print
        capture DIR/reference.png
        key C
        settle
        capture DIR/off.png
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Image wipe = image("wipe.png"), wiped = image("wiped.png"), off = image("off.png");
    EXPECT_NEAR(wipe.at(140, 5, 0), 0.85, 0.01);  // the line is in the middle of the picture
    EXPECT_NEAR(wiped.at(60, 5, 0), 0.85, 0.01);  // and where it was dragged
    EXPECT_LT(off.at(140, 5, 0), 0.5);
    EXPECT_THAT(value_of(result, "right"), HasSubstr("left.png"));
    EXPECT_NE(image("beside.png").bytes, image("reference.png").bytes);
}

TEST_F(ViewWindow, the_reference_comes_beside_the_picture_and_can_be_stopped) {
    const ProgramResult result = view("builtin:spheres --size 170x130 --samples 1 -t lambert", R"(
        key tab
        key G
        settle
        print
        screenshot DIR/picture.png
        capture DIR/beside.png
        drag left 20 50 30 50
        key G
        wait 2
        key G
        settle
        print
        key G
        wait 1
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(value_of(result, "right"), "reference");
    const std::string first = result.out.substr(0, result.out.rfind("technique "));
    EXPECT_THAT(first, Not(HasSubstr("stale reference")));
    EXPECT_THAT(last_state(result),
                HasSubstr("stale reference"));  // stopped: the one of the old view is kept
    EXPECT_THAT(result.out, Not(HasSubstr("notice ")));
    // The right half shows the same spheres with more light from bounces and less from approximations.
    const Image picture = image("picture.png"), beside = image("beside.png");
    double difference = 0, brightness = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = picture.width * 5 / 8; x < picture.width; ++x) {
            difference += std::abs(picture.at(x, y, 1) - beside.at(x, y, 1));
            brightness += picture.at(x, y, 1);
        }
    EXPECT_LT(difference, 0.2 * brightness);
    EXPECT_GT(difference, 0);
}

TEST_F(ViewWindow, a_skin_tone_brings_its_profile_and_colour_and_goes_again) {
    const ProgramResult result = view("builtin:spheres --size 200x140 --samples 1 -t wrap", R"(
        settle
        screenshot DIR/before.png
        tone 6
        settle
        print
        screenshot DIR/dark.png
        tone 0
        settle
        screenshot DIR/after.png
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(value_of(result, "profile"), "openpbr_skin_6");
    const Image before = image("before.png"), dark = image("dark.png");
    double difference = 0;
    for (int y = 0; y < before.height; ++y)
        for (int x = 0; x < before.width; ++x) difference += before.at(x, y, 0) - dark.at(x, y, 0);
    EXPECT_GT(difference / double(before.pixel_count()), 0.02);
    EXPECT_EQ(before.bytes, image("after.png").bytes);
}

}  // namespace dermis
