// Clips and morph targets in the window.

#include <gmock/gmock.h>

#include "support/moving_sheet.h"
#include "view/window_fixture.h"

namespace dermis {
namespace {

using ::testing::HasSubstr;

const std::string kWindow = " --size 400x240 --samples 1 -t lambert ";

}  // namespace

class ViewMotion : public ViewWindow {
  protected:
    void SetUp() override {
        ViewWindow::SetUp();
        ASSERT_TRUE(write_text_file(path("sheet.gltf"), test::moving_sheet()));
    }

    /// Runs the line of the last ctrl+C and compares it with DIR/seen.png, byte by byte.
    void expect_copied_line_draws_what_was_seen(const ProgramResult& result) {
        const std::string line = value_of(result, "clipboard");
        ASSERT_TRUE(line.starts_with("dermis render ")) << line;
        const ProgramResult drawn = shell(DERMIS_PROGRAM + line.substr(6) + " -o " + path("drawn.png"));
        ASSERT_EQ(drawn.exit_code, 0) << line << drawn.err;
        EXPECT_TRUE(image("seen.png").bytes == image("drawn.png").bytes) << line;
    }
};

TEST_F(ViewMotion, a_pose_of_the_script_is_the_picture_that_render_draws) {
    const ProgramResult result = view(path("sheet.gltf") + " --size 400x240 --samples 1 -t preintegrated", R"(
        settle
        screenshot DIR/rest.png
        clip nod
        time 1.25
        morph lift 0.5
        wait 2
        screenshot DIR/live.png
        key ctrl+C
        settle
        print
        screenshot DIR/seen.png
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(value_of(result, "clipboard"), HasSubstr(" --clip nod --time 1.25 --morph lift=0.5 "));
    EXPECT_FALSE(image("rest.png").bytes == image("live.png").bytes) << "the vertices move at once";
    expect_copied_line_draws_what_was_seen(result);
}

TEST_F(ViewMotion, a_scene_starts_where_the_command_line_says_and_goes_back_to_rest) {
    const ProgramResult result = view(path("sheet.gltf") + kWindow + "--clip nod --time 0.5", R"(
        settle
        screenshot DIR/start.png
        print
        clip ""
        time 0
        settle
        key ctrl+C
        wait 2
        print
        screenshot DIR/seen.png
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(value_of(result, "clip"), "nod");
    EXPECT_EQ(value_of(result, "time_s"), "0.5");
    EXPECT_FALSE(image("start.png").bytes == image("seen.png").bytes);
    EXPECT_THAT(last_state(result), HasSubstr("clip \n"));
    const std::string state = last_state(result);
    const size_t at = state.find("clipboard ") + 10;
    const std::string line = state.substr(at, state.find('\n', at) - at);
    const ProgramResult drawn = shell(DERMIS_PROGRAM + line.substr(6) + " -o " + path("drawn.png"));
    ASSERT_EQ(drawn.exit_code, 0) << line << drawn.err;
    EXPECT_TRUE(image("seen.png").bytes == image("drawn.png").bytes) << line;
}

TEST_F(ViewMotion, playing_takes_the_time_of_the_clock_and_stops_at_the_end_of_the_clip) {
    const ProgramResult result = view(path("sheet.gltf") + kWindow, R"(
        print
        key space
        wait 15
        pause
        print
        time 1.5
        play
        wait 20
        settle
        print
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    std::vector<double> times_s, frames;
    std::vector<std::string> playing;
    for (const std::string_view line : split(result.out, '\n')) {
        if (line.starts_with("time_s ")) times_s.push_back(*parse_number(line.substr(7)));
        if (line.starts_with("frame ")) frames.push_back(*parse_number(line.substr(6)));
        if (line.starts_with("playing ")) playing.emplace_back(line.substr(8));
    }
    ASSERT_EQ(times_s.size(), 3u);
    EXPECT_EQ(times_s[0], 0);
    // Between the prints: the frames of both keys, of the wait, and of the commands themselves.
    EXPECT_NEAR(times_s[1], (frames[1] - frames[0]) / 30, 4.0 / 30);
    EXPECT_GE(times_s[1], 15.0 / 30);
    EXPECT_EQ(times_s[2], 2) << "the clip's length";
    EXPECT_EQ(playing, (std::vector<std::string>{"no", "no", "no"}));
}

TEST_F(ViewMotion, the_saved_scene_has_its_pose_and_its_unknown_names_are_one_line) {
    const ProgramResult saved = view(path("sheet.gltf") + kWindow, R"(
        clip nod
        time 0.75
        morph lift 0.25
        click section.Warnings
        click section.Head
        slide motion.speed 1
        save DIR/saved.toml
        print
        quit
    )");
    ASSERT_EQ(saved.exit_code, 0) << saved.err;
    const Result<std::string> text = read_text_file(path("saved.toml"));
    ASSERT_TRUE(text) << text.error().message;
    for (const std::string& line : {std::string("[animation]\nclip = \"nod\"\ntime_s = "),
                                    std::string("speed = 4\n"), std::string("[morph]\nlift = 0.25\n")})
        EXPECT_THAT(*text, HasSubstr(line));
    const ProgramResult again = view(path("saved.toml") + kWindow, "print\nquit\n");
    EXPECT_EQ(value_of(again, "time_s"), value_of(saved, "time_s")) << again.err;
    EXPECT_EQ(value_of(again, "morph"), "lift=0.25");
    for (const auto& [command, name] :
         {std::pair("clip nood", "'nood'"), std::pair("morph lid 1", "'lid'")}) {
        const ProgramResult wrong = view(path("sheet.gltf") + kWindow, std::string(command) + "\nquit\n");
        EXPECT_EQ(wrong.exit_code, 1);
        EXPECT_THAT(wrong.err, HasSubstr(std::string("script.txt:1: ")));
        EXPECT_THAT(wrong.err, HasSubstr(name));
    }
    const ProgramResult still = view(square() + kWindow, "play\nquit\n");
    EXPECT_THAT(still.err, HasSubstr("this scene has no clip to play"));
}

}  // namespace dermis
