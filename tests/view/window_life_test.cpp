// A window's sizes, a lost device, long switching, failed starts.

#include <gmock/gmock.h>

#include "view/window_fixture.h"

namespace dermis {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

}  // namespace

TEST_F(ViewWindow, after_twenty_sizes_the_window_has_the_last) {
    std::string script;
    for (int i = 0; i < 20; ++i)
        script +=
            "resize " + std::to_string(200 + 37 * (i % 7)) + " " + std::to_string(140 + 29 * (i % 5)) + "\n";
    const ProgramResult result =
        view(square() + " --size 300x200 --samples 1",
             script + "resize 400 300\nsettle\ncapture DIR/window.png\nprint\nquit\n");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(value_of(result, "window"), "400x300");
    EXPECT_EQ(image("window.png").width, 400);
    EXPECT_EQ(image("window.png").height, 300);
}

TEST_F(ViewWindow, five_hundred_frames_of_switching_leave_no_memory_behind) {
    std::string script;
    const auto switches = [&](int count) {
        for (int i = 0; i < count; ++i)
            script += i % 2 ? "technique lambert\n" : i % 5 ? "technique wrap\n" : "technique oren_nayar\n";
    };
    switches(100);
    script += "print\n";
    switches(400);
    const ProgramResult result = view(square() + " --size 160x120 --samples 1 -t lambert",
                                      script + "print\nquit\n", "");  // the layers keep memory
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const size_t second = result.out.rfind("memory_mb ");
    const double before_mb = std::stod(value_of(result, "memory_mb")),
                 after_mb = std::stod(result.out.substr(second + 10));
    EXPECT_GT(before_mb, 10);
    EXPECT_LT(after_mb - before_mb, 12);
}

TEST_F(ViewWindow, a_hundred_frames_of_the_same_view_and_those_of_a_drag_make_no_vulkan_object) {
    // Techniques with a light map make a coarser one while the mouse moves.
    const ProgramResult result = view(square() + " -t preintegrated --size 300x200 --samples 1", R"(
        settle
        drag left 90 90 120 80
        wait 20
        print
        wait 100
        drag left 90 90 120 80
        print
        resize 400 300
        wait 2
        print
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    std::vector<int> frames, objects;
    for (const std::string_view line : split(result.out, '\n')) {
        if (line.starts_with("frame ")) frames.push_back(std::stoi(std::string(line.substr(6))));
        if (line.starts_with("device_objects ")) objects.push_back(std::stoi(std::string(line.substr(15))));
    }
    ASSERT_EQ(objects.size(), 3u);
    EXPECT_GE(frames[1] - frames[0], 100);
    EXPECT_EQ(objects[1], objects[0]);
    EXPECT_GT(objects[2], objects[1]) << "the count does not see what another size makes";
}

TEST_F(ViewWindow, on_a_slow_device_the_first_picture_is_coarse_and_the_last_has_every_pass_and_sample) {
    const ProgramResult result = view(square() +
                                          " --size 640x480 -t texture_space --set light_map_size=512 --set "
                                          "blur=gaussian --set blur_passes=8",
                                      R"(
        print
        settle
        print
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    if (result.out.find("on llvmpipe") == std::string::npos) GTEST_SKIP() << "no slow device";
    const std::string last = last_state(result);
    EXPECT_THAT(last, HasSubstr("picture 320x454 4\n"));
    const int first_width = std::stoi(value_of(result, "picture"));
    EXPECT_LT(first_width, 320);
    // Half of the blur's passes, and no resolve of the samples.
    EXPECT_LE(std::stoi(value_of(result, "passes")), std::stoi(last.substr(last.find("passes ") + 7)) - 5);
}

TEST_F(ViewWindow, a_lost_device_is_opened_again_with_what_was_seen) {
    const ProgramResult result = view(kSmall + "-t wrap", R"(
        set wrap=0.125
        drag left 90 90 120 80
        key Y
        key C
        tone 3
        settle
        print
        screenshot DIR/before.png
        lose_device
        settle
        print
        screenshot DIR/after.png
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::string last = last_state(result);
    EXPECT_THAT(last, HasSubstr("set wrap=0.125\n"));
    EXPECT_THAT(last, HasSubstr("right lambert\n"));
    EXPECT_THAT(last, HasSubstr("profile openpbr_skin_3\n"));
    EXPECT_THAT(last, HasSubstr("camera " + value_of(result, "camera")));
    EXPECT_EQ(image("before.png").bytes, image("after.png").bytes);
}

TEST_F(ViewWindow, minimised_it_waits_and_comes_back_with_its_picture) {
    std::string manners = "RandomPlacement\nNoTitle\n";
    for (const char* font : {"TitleFont", "IconFont", "MenuFont", "ResizeFont", "IconManagerFont"})
        manners += std::string(font) + " \"fixed\"\n";  // the one that every X server has
    ASSERT_TRUE(write_text_file(path("twmrc"), manners));
    const ChildProgram manager({"twm", "-display", display_->name(), "-f", path("twmrc")});
    if (!manager.started()) GTEST_SKIP() << "no window manager to minimise with; apt-get install twm";
    const ProgramResult result = view(square() + " --size 300x200 --samples 1 -t lambert", R"(
        settle
        screenshot DIR/before.png
        minimise
        wait 40
        print
        technique wrap
        settle
        technique lambert
        restore
        wait 20
        settle
        print
        screenshot DIR/after.png
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(value_of(result, "minimised"), "yes");
    EXPECT_THAT(last_state(result), HasSubstr("minimised no\n"));
    EXPECT_THAT(last_state(result), HasSubstr("window 300x200\n"));
    EXPECT_EQ(image("before.png").bytes, image("after.png").bytes);
}

TEST_F(ViewWindow, on_a_display_of_twice_the_dots_everything_is_twice_as_large) {
    const VirtualDisplay fine("1280x960");
    if (shell("xprop -display " + fine.name() +
              " -root -f RESOURCE_MANAGER 8s -set RESOURCE_MANAGER 'Xft.dpi: 192'")
            .exit_code != 0)
        GTEST_SKIP() << "no xprop to say so with; apt-get install x11-utils";
    ASSERT_TRUE(write_text_file(path("script.txt"), "settle\nprint\nquit\n"));
    const ProgramResult result = shell(program(fine) + " view " + square() +
                                       " --size 400x300 --samples 1 --script " + path("script.txt"));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(value_of(result, "window"), "800x600");
    EXPECT_EQ(value_of(result, "interface_scale"), "2");
}

TEST_F(ViewWindow, what_cannot_start_says_why_in_one_line) {
    const std::string program = DERMIS_PROGRAM;
    const ProgramResult no_display =
        shell("env -u DISPLAY -u WAYLAND_DISPLAY " + program + " view builtin:spheres");
    EXPECT_EQ(no_display.exit_code, 1);
    EXPECT_THAT(no_display.err, HasSubstr("xvfb-run"));
    EXPECT_EQ(std::count(no_display.err.begin(), no_display.err.end(), '\n'), 1);
    const ProgramResult no_scene = view("/nowhere.toml", "quit");
    EXPECT_EQ(no_scene.exit_code, 1);
    EXPECT_THAT(no_scene.err, HasSubstr("/nowhere.toml"));
    const ProgramResult bad_script = view(kSmall, "wait 1\nset nothing=1\n");
    EXPECT_EQ(bad_script.exit_code, 1);
    EXPECT_THAT(bad_script.err, HasSubstr("script.txt:2: unknown parameter 'nothing'"));
}

}  // namespace dermis
