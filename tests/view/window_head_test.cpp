// A head of one's own: its materials, unit and tone, changed in the window, saved and opened again.

#include <gmock/gmock.h>

#include "view/window_fixture.h"

namespace dermis {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// The lines of the last print that begin with one of the words.
std::string lines_of(const std::string& state, const std::vector<std::string>& words) {
    std::string lines;
    for (const std::string_view line : split(state, '\n'))
        for (const std::string& word : words)
            if (line.starts_with(word + " ")) lines += std::string(line) + "\n";
    return lines;
}

double mean_difference(const Image& a, const Image& b) {
    if (a.bytes.size() != b.bytes.size()) return 1;
    double sum = 0;
    for (size_t i = 0; i < a.bytes.size(); ++i)
        sum += std::abs(std::to_integer<int>(a.bytes[i]) - std::to_integer<int>(b.bytes[i]));
    return sum / 255 / double(a.bytes.size());
}

const std::vector<std::string> kHead = {"unit_mm", "material", "tone", "profile"};

// What each print said.
std::vector<std::string> head_states(const ProgramResult& result) {
    std::vector<std::string> states;
    for (size_t at = result.out.find("technique "); at != std::string::npos;) {
        const size_t next = result.out.find("\ntechnique ", at);
        states.push_back(result.out.substr(at, next == std::string::npos ? next : next + 1 - at));
        at = next == std::string::npos ? next : next + 1;
    }
    return states;
}

std::string head_line(const std::string& state, const std::string& word) {
    return lines_of(state, {word});
}

}  // namespace

class ViewHead : public ViewWindow {
  protected:
    /// Two squares of 20 cm: a face, and an eye in front of it. No class is stated.
    std::string head() {
        (void)square();
        EXPECT_TRUE(write_text_file(path("head.mtl"),
                                    "newmtl M Face\nmap_Kd white.png\nnewmtl M_Eye\nKd 0.1 0.2 0.9\n"));
        EXPECT_TRUE(
            write_text_file(path("head.obj"),
                            "mtllib head.mtl\nusemtl M Face\nv -10 -10 0\nv 10 -10 0\nv 10 10 0\nv -10 10 0\n"
                            "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n"
                            "usemtl M_Eye\nv -4 -4 1\nv 4 -4 1\nv 4 4 1\nv -4 4 1\nf 5/1 6/2 7/3 8/4\n"));
        return path("head.obj");
    }
};

TEST_F(ViewHead,
       changes_of_materials_unit_and_tone_are_drawn_and_the_saved_scene_has_them_without_a_warning) {
    const ProgramResult result =
        view(head() + " --scene mesh.unit_mm=10 --size 900x700 --samples 1 -t wrap", R"(
        settle
        screenshot DIR/first.png
        click "head.M_Eye.visible"
        settle
        screenshot DIR/no_eye.png
        click "head.M_Eye.visible"
        scene material.M_Eye.class=teeth
        scene "material.M Face.profile=jensen_skin2"
        scene mesh.unit_mm=9
        click "head.M_Eye.visible"
        tone 5
        settle
        screenshot DIR/changed.png
        save DIR/saved.toml
        print
        open DIR/saved.toml
        settle
        screenshot DIR/again.png
        print
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Image first = image("first.png"), no_eye = image("no_eye.png");
    const int x = first.width / 2, y = first.height / 2;
    EXPECT_GT(first.at(x, y, 2), first.at(x, y, 0) + 0.1f);  // the blue eye
    EXPECT_LT(no_eye.at(x, y, 2), no_eye.at(x, y, 0) + 0.05f);
    const std::string last = last_state(result);
    const std::string changed = lines_of(result.out.substr(0, result.out.rfind("technique ")), kHead);
    EXPECT_EQ(changed,
              "unit_mm head 9\nmaterial M Face skin profile jensen_skin2\nmaterial M_Eye teeth hidden\n"
              "tone 5\nprofile openpbr_skin_5\n");
    EXPECT_EQ(lines_of(last, kHead), changed);
    EXPECT_THAT(last, Not(HasSubstr("\nwarning")));
    EXPECT_THAT(last, Not(HasSubstr("\nnotice")));
    // A saved camera is rounded to 1e-4.
    EXPECT_LT(mean_difference(image("changed.png"), image("again.png")), 0.002);
    EXPECT_GT(mean_difference(image("changed.png"), first), 0.02);
}

TEST_F(ViewHead, another_unit_keeps_the_framing_and_a_change_that_cannot_be_loaded_is_taken_back) {
    const ProgramResult result =
        view(head() + " --scene mesh.unit_mm=10 --size 900x700 --samples 1 -t lambert", R"(
        settle
        screenshot DIR/cm.png
        scene mesh.unit_mm=25.4
        settle
        screenshot DIR/inch.png
        scene "material.M Face.profile=no_such_profile"
        settle
        print
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_LT(mean_difference(image("cm.png"), image("inch.png")), 0.005);
    EXPECT_THAT(result.out, HasSubstr("unit_mm head 25.4\n"));
    EXPECT_THAT(result.out, HasSubstr("notice material.M Face.profile: unknown profile 'no_such_profile'"));
    EXPECT_THAT(result.out, HasSubstr("material M Face skin\n"));
}

TEST_F(ViewHead, warnings_of_loading_and_of_techniques_stay_until_they_are_read) {
    const ProgramResult result =
        view(head() + " --scene mesh.unit_mm=10 --size 900x700 --samples 1 -t wrap", R"(
        settle
        key escape
        wait 130
        print
        click warning.1
        wait 1
        print
        scene "material.M_Eye.visible=false"
        technique preintegrated
        set curvature=image
        settle
        print
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::vector<std::string> states = head_states(result);
    ASSERT_EQ(states.size(), 3u);
    EXPECT_THAT(states[0], HasSubstr("\nwarning 'head': classes found by name: eye 'M_Eye'"));
    EXPECT_THAT(states[1], Not(HasSubstr("classes found by name")));
    EXPECT_THAT(states[2], Not(HasSubstr("classes found by name")));  // the same text, of the second loading
    EXPECT_THAT(states[2], HasSubstr("\nwarning material 'M Face' has no curvature map"));
}

TEST_F(ViewHead, undo_takes_back_one_change_after_the_other_and_redo_brings_them_again) {
    const ProgramResult result =
        view(head() + " --scene mesh.unit_mm=10 --size 900x700 --samples 1 -t wrap", R"(
        settle
        screenshot DIR/first.png
        set wrap=0.125
        tone 5
        scene material.M_Eye.class=teeth
        click section.Head
        slide picture.exposure_ev 0.9
        drag left 90 90 120 80
        print
        undo
        print
        key ctrl+Z
        settle
        print
        undo
        undo
        undo
        key F
        settle
        screenshot DIR/undone.png
        print
        redo
        redo
        key ctrl+shift+Z
        redo
        settle
        print
        quit
    )");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::vector<std::string> words = {"set", "tone", "material", "exposure_ev"};
    const std::vector<std::string> states = head_states(result);
    ASSERT_EQ(states.size(), 5u);
    EXPECT_THAT(states[0], HasSubstr("material M_Eye teeth"));
    EXPECT_THAT(states[0], Not(HasSubstr("exposure_ev 0.6\n")));
    EXPECT_THAT(states[1], HasSubstr("exposure_ev 0.6\n"));  // the whole drag of the slider
    EXPECT_EQ(head_line(states[1], "camera"), head_line(states[0], "camera"));
    EXPECT_THAT(states[1], HasSubstr("material M_Eye teeth"));
    EXPECT_THAT(states[2], HasSubstr("material M_Eye eye"));
    EXPECT_THAT(states[2], HasSubstr("tone 5\n"));
    EXPECT_THAT(states[3], HasSubstr("tone 0\n"));
    EXPECT_THAT(states[3], HasSubstr("set wrap=0.25\n"));
    EXPECT_THAT(states[3], HasSubstr("notice nothing to undo\n"));
    EXPECT_EQ(lines_of(states[4], words), lines_of(states[0], words));
}

}  // namespace dermis
