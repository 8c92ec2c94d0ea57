// Two pictures beside each other, and the same head in another skin.

#include <gmock/gmock.h>

#include <cmath>

#include "view/window_fixture.h"

namespace dermis {
namespace {

using ::testing::AllOf;
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
        wait 1
        print
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
    const size_t moved = result.out.find("technique ", result.out.find("technique ") + 1);
    EXPECT_THAT(result.out.substr(0, moved), Not(HasSubstr("stale reference")));
    EXPECT_THAT(result.out.substr(moved), HasSubstr("stale reference"));
    EXPECT_THAT(last_state(result), HasSubstr("right reference"));  // stopped: what there is is kept
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

// So large that it takes far longer than the frames.
TEST_F(ViewWindow, the_reference_is_shown_while_it_is_refined) {
    const ProgramResult result = view("bust --size 700x500 --samples 1 -t lambert", R"(
        key tab
        settle
        key G
        wait 400
        print
        capture DIR/early.png
        key G
        settle
        print
        capture DIR/stopped.png
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::string first = result.out.substr(0, result.out.rfind("technique "));
    EXPECT_THAT(first, AllOf(HasSubstr("right reference"), HasSubstr("(G stops)")));
    EXPECT_THAT(last_state(result), AllOf(HasSubstr("right reference"), Not(HasSubstr("(G stops)"))));
    // The first picture is no other than the last, but for noise.
    const Image early = image("early.png"), stopped = image("stopped.png");
    double difference = 0, brightness = 0;
    for (int y = 40; y < early.height; ++y)
        for (int x = early.width * 5 / 8; x < early.width; ++x) {
            difference += std::abs(early.at(x, y, 1) - stopped.at(x, y, 1));
            brightness += stopped.at(x, y, 1);
        }
    EXPECT_LT(difference, 0.1 * brightness);
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

// Mean of red, green, blue over the picture.
Vec3 mean_colour(const Image& picture) {
    Vec3 sum;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            sum += {picture.at(x, y, 0), picture.at(x, y, 1), picture.at(x, y, 2)};
    return sum * (1 / float(picture.pixel_count()));
}

// From a scene file with a camera: a saved camera is rounded, and then so is the one of the window.
TEST_F(ViewWindow, sliders_of_pigments_darken_and_redden_the_skin_undo_and_are_saved) {
    ASSERT_TRUE(write_text_file(path("script.txt"), R"(
        save start.toml
        open start.toml
        settle
        click section.Skin
        wait 5
        slide skin.melanin 0.12
        settle
        screenshot fair.png
        slide skin.melanin 0.5
        settle
        screenshot dark.png
        print
        undo
        settle
        screenshot undone.png
        slide skin.blood 0.9
        settle
        screenshot red.png
        slide skin.oxygen 0
        settle
        screenshot veins.png
        print
        key ctrl+S
        wait 2
        quit
    )"));
    const std::string here = "cd " + directory_.path.string() + " && ";
    const ProgramResult result =
        shell(here + program(*display_) +
              " view builtin:spheres --size 900x900 --samples 1 -t wrap --validate --script script.txt");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("\nprofile skin:melanin=0.2"));
    EXPECT_THAT(last_state(result), AllOf(HasSubstr("\nprofile skin:melanin=0.0"), HasSubstr(",blood=0.09"),
                                          HasSubstr(",oxygen=0\n")));
    const Vec3 fair = mean_colour(image("fair.png")), dark = mean_colour(image("dark.png")),
               red = mean_colour(image("red.png")), veins = mean_colour(image("veins.png"));
    for (const auto channel : {&Vec3::x, &Vec3::y, &Vec3::z}) EXPECT_LT(dark.*channel, 0.95f * fair.*channel);
    EXPECT_GT(red.x / red.y, 1.03f * fair.x / fair.y);
    EXPECT_LT(veins.x, red.x) << "blood without oxygen absorbs more red";
    EXPECT_EQ(image("fair.png").bytes, image("undone.png").bytes);

    const Image shown = image("veins.png");
    const ProgramResult rendered =
        shell(here + DERMIS_PROGRAM + " render spheres-001.toml --samples 1 --size " +
              std::to_string(shown.width) + "x" + std::to_string(shown.height) + " -o again.png");
    ASSERT_EQ(rendered.exit_code, 0) << rendered.err;
    EXPECT_EQ(image("again.png").bytes, shown.bytes);
}

}  // namespace dermis
