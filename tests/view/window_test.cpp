// The program as a person uses it: scripted hands, a display of our own, validation layers on.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "cli/run_program.h"
#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/image/io.h"
#include "dermis/technique/technique.h"
#include "support/temporary_directory.h"
#include "view/display.h"

namespace dermis {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class ViewWindow : public ::testing::Test {
  protected:
    static void SetUpTestSuite() { display_ = std::make_unique<VirtualDisplay>("1024x768"); }
    static void TearDownTestSuite() { display_.reset(); }
    void SetUp() override {
        if (display_->name().empty()) GTEST_SKIP() << "no Xvfb; apt-get install xvfb";
    }

    ProgramResult shell(const std::string& line) { return run_shell(line, directory_.path.string()); }
    std::string path(const std::string& name) { return (directory_.path / name).string(); }

    /// Runs `dermis view` with a script; paths in it may use DIR.
    ProgramResult view(const std::string& arguments, std::string script, const char* layers = " --validate") {
        for (size_t at; (at = script.find("DIR")) != script.npos;)
            script.replace(at, 3, directory_.path.string());
        EXPECT_TRUE(write_text_file(path("script.txt"), script));
        return shell("DISPLAY=" + display_->name() + " XDG_STATE_HOME=" + path("state") + " " +
                     DERMIS_PROGRAM + " view " + arguments + layers + " --script " + path("script.txt"));
    }

    Image image(const std::string& name) {
        Result<LoadedImage> loaded = read_image(path(name), ImageUse::color);
        EXPECT_TRUE(loaded) << loaded.error().message;
        return loaded ? std::move(loaded->image) : Image();
    }

    /// The rest of the line of standard output that begins with `key`.
    static std::string value_of(const ProgramResult& result, const std::string& key) {
        for (const std::string_view line : split(result.out, '\n'))
            if (line.starts_with(key + " ")) return std::string(line.substr(key.size() + 1));
        ADD_FAILURE() << "no '" << key << "' in " << result.out << result.err;
        return "";
    }

    TemporaryDirectory directory_;
    inline static std::unique_ptr<VirtualDisplay> display_;
};

constexpr const char* kSmall = "builtin:spheres --size 560x320 --samples 1 ";

}  // namespace

TEST_F(ViewWindow, a_view_found_with_the_mouse_is_the_picture_that_render_draws) {
    const ProgramResult result = view(std::string(kSmall) + "-t oren_nayar", R"(
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
    // Angles travel rounded to 1e-4 degrees, which may tip single pixels of an edge.
    int differing = 0;
    for (int y = 0; y < seen.height; ++y)
        for (int x = 0; x < seen.width; ++x)
            differing += std::abs(seen.at(x, y, 1) - again.at(x, y, 1)) > 2.5f / 255;
    EXPECT_LT(differing, seen.width * seen.height / 500);
}

TEST_F(ViewWindow, a_slider_sets_its_parameter) {
    const ProgramResult result = view(std::string(kSmall) + "-t wrap", R"(
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

TEST_F(ViewWindow, twenty_sizes_pass_and_the_window_has_the_last) {
    std::string script;
    for (int i = 0; i < 20; ++i)
        script +=
            "resize " + std::to_string(200 + 37 * (i % 7)) + " " + std::to_string(140 + 29 * (i % 5)) + "\n";
    const ProgramResult result =
        view(kSmall, script + "resize 400 300\nsettle\ncapture DIR/window.png\nprint\nquit\n");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(value_of(result, "window"), "400x300");
    EXPECT_EQ(image("window.png").width, 400);
    EXPECT_EQ(image("window.png").height, 300);
}

TEST_F(ViewWindow, every_technique_and_every_view_is_shown) {
    std::string script;
    for (size_t i = 1; i < all_techniques().size(); ++i) script += "key T\n";
    for (int i = 0; i < 14; ++i) script += "key V\n";
    const ProgramResult result =
        view("builtin:spheres --size 240x140 --samples 1 -t lambert",
             script + "key 0\nkey F1\nkey tab\nkey ctrl+=\nkey Y\nsettle\nprint\nquit\n");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(value_of(result, "view"), "final");
    EXPECT_THAT(result.out, Not(HasSubstr("pass '")));  // no notice of a picture that failed
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
    const ProgramResult result = view("builtin:spheres --size 160x120 --samples 1 -t lambert",
                                      script + "print\nquit\n", "");  // the layers keep memory
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const size_t second = result.out.rfind("peak_memory_mb ");
    const double before_mb = std::stod(value_of(result, "peak_memory_mb")),
                 after_mb = std::stod(result.out.substr(second + 15));
    EXPECT_GT(before_mb, 10);
    EXPECT_LT(after_mb - before_mb, 12);
}

TEST_F(ViewWindow, a_dropped_file_is_opened_and_one_that_is_none_is_a_notice) {
    ASSERT_TRUE(write_text_file(path("quad.obj"),
                                "v -100 -100 0\nv 100 -100 0\nv 100 100 0\nv -100 100 0\nf 1 2 3 4\n"));
    ASSERT_TRUE(write_text_file(path("broken.toml"), "[[mesh]]\nfile = 3\n"));
    const ProgramResult result = view(kSmall, R"(
        drop DIR/quad.obj
        settle
        print
        drop DIR/broken.toml
        settle
        print
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("scene " + path("quad.obj")));
    EXPECT_THAT(result.out, HasSubstr("broken.toml:2: mesh.file"));
}

TEST_F(ViewWindow, a_broken_shader_is_told_and_the_last_good_one_goes_on_until_it_is_mended) {
    const std::string source = DERMIS_SOURCE_DIR;
    ASSERT_EQ(shell("mkdir " + path("root") + " && cp -r " + source + "/shaders " + source + "/techniques " +
                    path("root"))
                  .exit_code,
              0);
    ASSERT_TRUE(write_text_file(path("broken.frag"), "#version 460\nvoid main() { colour = 1; }\n"));
    // Compiles, and does not fit its pass.
    ASSERT_TRUE(write_text_file(path("alien.frag"),
                                "#version 460\nlayout(location = 0) in vec4 nobody;\n"
                                "layout(location = 0) out vec4 c;\nvoid main() { c = nobody; }\n"));
    Result<std::string> good = read_text_file(source + "/shaders/shared/tone_map.frag");
    ASSERT_TRUE(good);
    const size_t alpha = good->rfind("1.0)");
    ASSERT_NE(alpha, std::string::npos);
    const std::string target = path("root") + "/shaders/shared/tone_map.frag";
    ASSERT_TRUE(write_text_file(path("red.frag"), good->replace(alpha, 4, "1.0) * vec4(1, 0, 0, 1)")));
    const ProgramResult result =
        view(std::string(kSmall) + "-t lambert --shaders " + path("root"),
             "settle\nscreenshot DIR/before.png\ncopy DIR/broken.frag " + target +
                 "\nwait 14\nprint\ndrag left 90 90 99 90\nsettle\n"
                 "screenshot DIR/still.png\ncopy DIR/alien.frag " +
                 target + "\nwait 14\nsettle\nscreenshot DIR/alien.png\ncopy DIR/red.frag " + target +
                 "\nwait 14\nsettle\nscreenshot DIR/red.png\nprint\nquit\n");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(value_of(result, "notice"), HasSubstr("tone_map.frag:2"));
    EXPECT_NE(image("before.png").bytes, image("still.png").bytes);  // the drag was drawn
    EXPECT_EQ(image("still.png").bytes, image("alien.png").bytes);
    const Image red = image("red.png");
    EXPECT_GT(red.at(5, 5, 0), 0);
    EXPECT_EQ(red.at(5, 5, 1), 0);
    EXPECT_THAT(result.out.substr(result.out.rfind("technique ")), Not(HasSubstr("notice")));
}

TEST_F(ViewWindow, a_scene_file_is_followed_and_saved_with_what_was_changed) {
    ASSERT_TRUE(
        write_text_file(path("a.toml"), "name = \"A\" # first\n[[mesh]]\nfile = \"builtin:spheres\"\n"));
    ASSERT_TRUE(write_text_file(path("b.toml"), "exposure_ev = 2\n[[mesh]]\nfile = \"builtin:spheres\"\n"));
    ASSERT_TRUE(write_text_file(path("c.toml"), "exposure_ev = \n"));
    const ProgramResult result = view(path("a.toml") + " --size 560x320 --samples 1 -t wrap", R"(
        set wrap=0.125
        drag left 90 90 120 80
        save DIR/saved.toml
        copy DIR/c.toml DIR/a.toml
        wait 14
        print
        copy DIR/b.toml DIR/a.toml
        wait 14
        print
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("a.toml:1: not TOML"));
    const std::string last = result.out.substr(result.out.rfind("technique "));
    EXPECT_THAT(last, HasSubstr("exposure_ev 2\n"));
    EXPECT_THAT(last, Not(HasSubstr("not TOML")));
    EXPECT_THAT(last, HasSubstr("camera " + value_of(result, "camera")));  // the view stayed
    const Result<std::string> saved = read_text_file(path("saved.toml"));
    ASSERT_TRUE(saved);
    EXPECT_THAT(*saved, HasSubstr("name = \"A\" # first"));
    EXPECT_THAT(*saved, HasSubstr("wrap = 0.125"));
    EXPECT_TRUE(std::filesystem::exists(path("state") + "/dermis/view.toml"));
}

TEST_F(ViewWindow, two_techniques_and_a_picture_stand_beside_each_other) {
    const ProgramResult result = view(std::string(kSmall) + "-t lambert", R"(
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
        capture DIR/truth.png
        key C
        settle
        capture DIR/off.png
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Image wipe = image("wipe.png"), wiped = image("wiped.png"), off = image("off.png");
    EXPECT_NEAR(wipe.at(140, 5, 0), 0.85, 0.01);  // the line stands in the middle of the picture
    EXPECT_NEAR(wiped.at(60, 5, 0), 0.85, 0.01);  // and where it was dragged
    EXPECT_LT(off.at(140, 5, 0), 0.5);
    EXPECT_THAT(value_of(result, "right"), HasSubstr("left.png"));
    EXPECT_NE(image("beside.png").bytes, image("truth.png").bytes);
}

TEST_F(ViewWindow, a_lost_device_is_opened_again_with_what_was_seen) {
    const ProgramResult result = view(std::string(kSmall) + "-t wrap", R"(
        set wrap=0.125
        drag left 90 90 120 80
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
    const std::string last = result.out.substr(result.out.rfind("technique "));
    EXPECT_THAT(last, HasSubstr("set wrap=0.125\n"));
    EXPECT_THAT(last, HasSubstr("camera " + value_of(result, "camera")));
    EXPECT_EQ(image("before.png").bytes, image("after.png").bytes);
}

TEST_F(ViewWindow, the_ground_truth_comes_beside_the_picture_and_can_be_stopped) {
    const ProgramResult result = view("builtin:spheres --size 170x130 --samples 1 -t lambert", R"(
        key tab
        key tab
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
    EXPECT_THAT(result.out, Not(HasSubstr("notice ")));
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

TEST_F(ViewWindow, a_view_is_copied_as_a_command_and_pasted) {
    const ProgramResult result = view(std::string(kSmall) + "-t wrap", R"(
        drag left 90 90 120 80
        key ctrl+C
        wait 1
        print
        clipboard "-t oren_nayar --camera 'yaw=12 pitch=3'"
        key ctrl+V
        wait 1
        print
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(value_of(result, "clipboard"),
                HasSubstr("dermis render builtin:spheres -t wrap --camera 'yaw="));
    const std::string last = result.out.substr(result.out.rfind("technique "));
    EXPECT_THAT(last, HasSubstr("technique oren_nayar\n"));
    EXPECT_THAT(last, HasSubstr("camera yaw=12 pitch=3 "));
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
