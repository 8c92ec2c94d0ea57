// Input of the window: mouse, keys, widgets, views as text.

#include <gmock/gmock.h>

#include "dermis/scene/scene.h"
#include "support/built_in.h"
#include "view/window_fixture.h"

namespace dermis {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

}  // namespace

TEST_F(ViewWindow, a_view_found_with_the_mouse_is_the_picture_that_render_draws) {
    const ProgramResult result = view(kSmall + "-t oren_nayar", R"(
        drag left 100 100 130 90
        drag left 100 100 110 120 ctrl
        drag middle 100 100 95 105
        scroll 100 100 2
        key T
        print
        screenshot DIR/view.png
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::string camera = value_of(result, "camera"), light = value_of(result, "light");
    EXPECT_THAT(value_of(result, "technique"), Not("oren_nayar"));
    const Image seen = image("view.png");
    const ProgramResult drawn =
        shell(std::string(DERMIS_PROGRAM) + " render builtin:spheres -t " + value_of(result, "technique") +
              " --camera '" + camera + "' --light '" + light + "' --size " + std::to_string(seen.width) +
              "x" + std::to_string(seen.height) + " -o " + path("render.png"));
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const Image again = image("render.png");
    ASSERT_EQ(again.bytes.size() / again.channels, seen.bytes.size() / seen.channels);
    // Angles are rounded to 1e-4 degrees in the text, which may change single pixels of an edge.
    int differing = 0;
    for (int y = 0; y < seen.height; ++y)
        for (int x = 0; x < seen.width; ++x)
            differing += std::abs(seen.at(x, y, 1) - again.at(x, y, 1)) > 2.5f / 255;
    EXPECT_LT(differing, seen.width * seen.height / 500);
}

TEST_F(ViewWindow, the_help_is_whole_in_a_small_window_and_escape_closes_it) {
    for (const char* size : {"1000x700", "640x400"}) {
        const ProgramResult result = view(square() + " --samples 1 -t lambert --size " + size, R"(
            settle
            key escape
            wait 2
            capture DIR/without.png
            key F1
            wait 3
            capture DIR/with.png
            key escape
            wait 3
            capture DIR/closed.png
            quit
        )");
        ASSERT_EQ(result.exit_code, 0) << result.err;
        const Image without = image("without.png"), with = image("with.png"), closed = image("closed.png");
        const auto changed = [&](const Image& image, int x, int y) {
            return image.at(x, y, 0) != without.at(x, y, 0);
        };
        // Nothing of it reaches the window's edges, where it would be cut off. Times in the panels change
        // too.
        int open = 0, left = 0, at_edges = 0;
        for (int y = 0; y < with.height; ++y)
            for (int x = 0; x < with.width; ++x) {
                open += changed(with, x, y), left += changed(closed, x, y);
                const bool edge = x == 0 || y == 0 || x == with.width - 1 || y == with.height - 1;
                at_edges += edge && changed(with, x, y);
            }
        EXPECT_GT(open, with.width * with.height / 5) << "no help";
        EXPECT_LT(left, with.width * with.height / 50) << "escape does not close it";
        EXPECT_EQ(at_edges, 0) << size;
    }
}

TEST_F(ViewWindow, a_window_that_closes_before_its_first_picture_says_so) {
    const ProgramResult result = shell(program(*display_) + " view " + kSmall + "--frames 1");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("picture"));
    EXPECT_THAT(result.out, Not(HasSubstr("first picture after 0.00 s")));
}

TEST_F(ViewWindow, a_slider_sets_its_parameter) {
    const ProgramResult result = view(kSmall + "-t wrap --set width=source", R"(
        wait 2
        slide wrap 1
        wait 1
        print
        screenshot DIR/wrapped.png
        slide wrap 0
        wait 1
        screenshot DIR/unwrapped.png
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("set wrap=1\n"));
    EXPECT_NE(image("wrapped.png").bytes, image("unwrapped.png").bytes);
}

TEST_F(ViewWindow, every_technique_and_every_view_is_shown) {
    std::string script;
    for (const char* atlas : {"texture_space", "texture_space_gaussians"})
        script += std::string("technique ") + atlas + "\nset light_map_size=64\n";
    script += "technique lambert\n";
    for (size_t i = 1; i < built_in_catalog().techniques.size(); ++i) script += "key T\n";
    for (int i = 0; i < 14; ++i) script += "key V\n";
    const ProgramResult result =
        view(square() + " --size 240x140 --samples 1 -t lambert",
             script + "key 0\nkey F1\nkey tab\nkey ctrl+=\nkey Y\nsettle\nprint\nquit\n");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(value_of(result, "view"), "final");
    EXPECT_THAT(result.out, Not(HasSubstr("pass '")));  // no notice of a picture that failed
}

TEST_F(ViewWindow, a_copied_view_is_a_command_that_draws_the_same_bytes) {
    ASSERT_TRUE(write_image(path("around.hdr"), Image(16, 8, 3)));
    const ProgramResult result = view("builtin:spheres --size 400x240 --samples 4 -t wrap", R"(
        drag left 90 90 120 80
        drag left 90 90 95 105 ctrl
        drop DIR/around.hdr
        tone 4
        set wrap=0.3125
        clipboard "--scene environment.intensity=0.41234 --scene environment.yaw_deg=33.33333"
        key ctrl+V
        key ]
        key ctrl+C
        settle
        print
        screenshot DIR/seen.png
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    std::string line = value_of(result, "clipboard");
    ASSERT_TRUE(line.starts_with("dermis render builtin:spheres -t wrap ")) << line;
    EXPECT_THAT(line, HasSubstr(" --scene exposure_ev="));
    EXPECT_THAT(line,
                HasSubstr(" --scene environment.intensity=0.4123 --scene environment.yaw_deg=33.3333 "));
    const ProgramResult drawn = shell(DERMIS_PROGRAM + line.substr(6) + " -o " + path("drawn.png"));
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const Image seen = image("seen.png"), again = image("drawn.png");
    ASSERT_EQ(seen.width, again.width);
    int differing = 0;
    for (int y = 0; y < seen.height; ++y)
        for (int x = 0; x < seen.width; ++x)
            for (int c = 0; c < 3; ++c) differing += seen.at(x, y, c) != again.at(x, y, c);
    EXPECT_EQ(differing, 0) << line;
}

TEST_F(ViewWindow, a_view_is_pasted) {
    const ProgramResult result = view(square() + " --size 560x320 --samples 1 -t wrap", R"(
        clipboard "-t oren_nayar --camera 'yaw_deg=12 pitch_deg=3' --scene exposure_ev=2 --scene skin.profile=jensen_skin1"
        key ctrl+V
        wait 1
        print
        clipboard "--scene environment.file=/nowhere.hdr"
        key ctrl+V
        wait 1
        print
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::string last = last_state(result);
    EXPECT_THAT(last, HasSubstr("technique oren_nayar\n"));
    EXPECT_THAT(last, HasSubstr("camera yaw_deg=12 pitch_deg=3 "));
    EXPECT_THAT(last, HasSubstr("exposure_ev 2\n"));
    EXPECT_THAT(last, HasSubstr("profile jensen_skin1\n"));
    EXPECT_THAT(last, HasSubstr("environment studio\n"));
    EXPECT_THAT(last, HasSubstr("/nowhere.hdr"));
}

// The other tests here bypass the window library; these events come through the display.
TEST_F(ViewWindow, real_mouse_and_keys_do_what_the_scripted_ones_do) {
    if (!has_program("xdotool")) GTEST_SKIP() << "no xdotool; apt-get install xdotool";
    const std::string arguments = "view " + kSmall + "--validate -t lambert ";
    const std::string hands =
        "timeout 60 xdotool search --sync --name 'spheres - Dermis' "
        "mousemove 100 100 mousedown 1 mousemove 130 90 mouseup 1 mousemove 90 80 click 4 "
        "mousemove 100 100 keydown ctrl mousedown 1 mousemove 110 120 mouseup 1 keyup ctrl "
        "key t key ctrl+s key ctrl+q";
    const ProgramResult real =
        shell("cd " + path(".") + " && { " + program(*display_) + " " + arguments + " & " +
              "export DISPLAY=" + display_->name() + "; " + hands + " && wait $!; }");
    ASSERT_EQ(real.exit_code, 0) << real.err;
    const ProgramResult scripted = view(kSmall + "-t lambert", R"(
        drag left 100 100 130 90
        scroll 90 80 1
        drag left 100 100 110 120 ctrl
        key T
        save DIR/scripted.toml
        quit
    )");
    ASSERT_EQ(scripted.exit_code, 0) << scripted.err;
    const auto by_hand = load_built_in_scene(path("spheres-001.toml")),
               by_script = load_built_in_scene(path("scripted.toml"));
    ASSERT_TRUE(by_hand) << by_hand.error().message;
    ASSERT_TRUE(by_script) << by_script.error().message;
    EXPECT_NE(by_hand->technique, "lambert");
    EXPECT_EQ(by_hand->technique, by_script->technique);
    EXPECT_LT(length(by_hand->camera.eye_mm - by_script->camera.eye_mm), 1e-2f);
    EXPECT_LT(length(by_hand->key_light().to_light_world - by_script->key_light().to_light_world), 1e-4f);
}

}  // namespace dermis
