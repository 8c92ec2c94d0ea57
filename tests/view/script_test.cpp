#include "dermis/view/script.h"
#include "dermis/view/script_player.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dermis::view {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string error_of(std::string_view text) {
    const auto parsed = parse_script(text, "s.txt");
    return parsed ? "" : parsed.error().message;
}

TEST(ScriptPlayer, is_over_after_its_last_command) {
    const std::vector<view::ScriptCommand> commands(2);
    view::ScriptPlayer player(commands, "a"), none({}, "");
    EXPECT_FALSE(player.is_over(true));
    (void)player.next(true);
    EXPECT_FALSE(player.is_over(true));
    (void)player.next(true);
    EXPECT_TRUE(player.is_over(false));
    player.settle();
    EXPECT_FALSE(player.is_over(false)) << "the last command was settle";
    EXPECT_TRUE(player.is_over(true));
    EXPECT_FALSE(none.is_over(true)) << "without a script the user ends it";
}

TEST(Script, commands_come_out_with_their_words_and_lines) {
    const auto script =
        parse_script("# a comment\nopen \"my head.obj\" # why\n\n set wrap=0.4\nquit", "s.txt");
    ASSERT_TRUE(script) << script.error().message;
    ASSERT_EQ(script->size(), 3u);
    EXPECT_EQ((*script)[0].kind, CommandKind::open);
    EXPECT_THAT((*script)[0].words, ElementsAre("my head.obj"));
    EXPECT_EQ((*script)[0].line, 2);
    EXPECT_THAT((*script)[1].words, ElementsAre("wrap=0.4"));
    EXPECT_EQ((*script)[2].kind, CommandKind::quit);
}

TEST(Script, a_drag_presses_moves_and_releases_one_event_per_frame) {
    const auto script = parse_script("drag right 10 20 50 40 ctrl", "s.txt");
    ASSERT_TRUE(script) << script.error().message;
    const auto frames = input_frames(script->front());
    ASSERT_GE(frames.size(), 4u);
    EXPECT_TRUE(frames[1][0].pressed);
    EXPECT_EQ(frames[1][0].button, MouseButton::right);
    EXPECT_TRUE(frames[1][0].modifiers.ctrl);
    EXPECT_EQ(frames[1][0].position_px, (Vec2{10, 20}));
    EXPECT_FALSE(frames.back()[0].pressed);
    EXPECT_EQ(frames.back()[0].position_px, (Vec2{50, 40}));
}

TEST(Script, errors_name_their_line_and_the_correction) {
    EXPECT_THAT(error_of("quit\ntechniqe x"),
                HasSubstr("s.txt:2: unknown command 'techniqe'; did you mean 'technique'?"));
    EXPECT_THAT(error_of("drag left 1 2 3"), HasSubstr("drag left 300 300 420 280"));
    EXPECT_THAT(error_of("drag lift 1 2 3 4"), HasSubstr("'lift'; did you mean 'left'?"));
    EXPECT_THAT(error_of("scroll 1 2 x"), HasSubstr("'x' is not a number"));
    EXPECT_THAT(error_of("wait 1e99"), HasSubstr("not a number"));
    EXPECT_THAT(error_of("wait nan"), HasSubstr("not a number"));
    EXPECT_THAT(error_of("resize 0 10"), HasSubstr("resize 640 480"));
    EXPECT_THAT(error_of("open \"a"), HasSubstr("quotation mark"));
    EXPECT_THAT(error_of("key shft+A"), HasSubstr("'shft'; did you mean 'shift'?"));
}

TEST(Script, every_prefix_parses_or_fails_with_its_line) {
    const std::string whole = "open \"a b\"\ndrag left 1 2 3 4 ctrl+shift\nkey F12\nwait 3\nslide a.b 0.5\n";
    for (size_t length = 0; length <= whole.size(); ++length) {
        const std::string message = error_of(std::string_view(whole).substr(0, length));
        if (!message.empty()) {
            EXPECT_THAT(message, ::testing::StartsWith("s.txt:")) << length;
        }
    }
}

TEST(KeyChord, text_and_back) {
    for (const char* text : {"F1", "ctrl+C", "ctrl+shift+left", "tab", "[", "+", "ctrl++", "alt+F12"}) {
        const auto chord = parse_key_chord(text);
        ASSERT_TRUE(chord) << chord.error().message;
        EXPECT_EQ(key_chord_text(*chord), text);
    }
    EXPECT_FALSE(parse_key_chord("F13"));
    EXPECT_FALSE(parse_key_chord(""));
}

}  // namespace
}  // namespace dermis::view
