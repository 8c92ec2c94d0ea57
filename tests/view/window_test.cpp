// The program as a person uses it: scripted hands, a display of our own, validation layers on.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
    ProgramResult view(const std::string& arguments, std::string script) {
        for (size_t at; (at = script.find("DIR")) != script.npos;)
            script.replace(at, 3, directory_.path.string());
        EXPECT_TRUE(write_text_file(path("script.txt"), script));
        return shell("DISPLAY=" + display_->name() + " XDG_STATE_HOME=" + path("state") + " " +
                     DERMIS_PROGRAM + " view " + arguments + " --validate --script " + path("script.txt"));
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
