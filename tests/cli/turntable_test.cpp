#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "cli/run_program.h"
#include "dermis/base/file.h"
#include "dermis/image/io.h"
#include "support/temporary_directory.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

class Turntable : public testing::Test {
  protected:
    ProgramResult turn(const std::string& output, const std::string& environment = "",
                       const std::string& size = "16x16") {
        return run_shell(environment + " " + DERMIS_PROGRAM + " view builtin:spheres --size " + size +
                             " --samples 1 --turntable 3 -o " + path(output),
                         directory_.path.string());
    }
    std::string path(const std::string& name) { return (directory_.path / name).string(); }

    TemporaryDirectory directory_;
};

}  // namespace

TEST_F(Turntable, frames_are_drawn_without_a_window) {
    const ProgramResult result = turn("t%02d.png", "env -u DISPLAY");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(*read_file(path("t00.png")), *read_file(path("t02.png")));
    EXPECT_FALSE(std::filesystem::exists(path("t03.png")));
    EXPECT_THAT(turn("t.png").err, HasSubstr("numbered pictures"));
}

TEST_F(Turntable, a_film_has_every_frame_and_its_colours) {
    if (run_shell("ffmpeg -version && ffprobe -version", path("")).exit_code != 0)
        GTEST_SKIP() << "no ffmpeg to make a film with; apt-get install ffmpeg";
    ASSERT_EQ(turn("turn.mp4", "env -u DISPLAY", "65x48").exit_code, 0);
    ASSERT_EQ(turn("t%02d.png", "env -u DISPLAY", "65x48").exit_code, 0);
    const ProgramResult probe =
        run_shell("ffprobe -v error -count_frames -show_streams -show_format " + path("turn.mp4"), path(""));
    for (const char* line : {"width=64\n", "height=48\n", "nb_read_frames=3\n", "duration=0.100000\n",
                             "pix_fmt=yuv420p\n", "color_space=bt709\n", "color_transfer=iec61966-2-1\n"})
        EXPECT_THAT(probe.out, HasSubstr(line));
    ASSERT_EQ(
        run_shell("ffmpeg -v error -i " + path("turn.mp4") + " " + path("film%d.png"), path("")).exit_code,
        0);
    const auto frame = read_image(path("t02.png"), ImageUse::color),
               filmed = read_image(path("film3.png"), ImageUse::color);
    ASSERT_TRUE(frame && filmed);
    double difference = 0;
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c)
                difference += std::abs(frame->image.at(x, y, c) - filmed->image.at(x, y, c));
    EXPECT_LT(difference / (48 * 64 * 3), 3.0 / 255);
}

TEST_F(Turntable, a_film_needs_ffmpeg_and_leaves_no_frames) {
    std::filesystem::create_directory(path("bin"));
    const std::string own_path = "PATH=" + path("bin");
    const ProgramResult without = turn("turn.mp4", own_path);
    EXPECT_EQ(without.exit_code, 1);
    EXPECT_THAT(without.err, HasSubstr("apt-get install ffmpeg"));
    // Replaces ffmpeg: writes its last argument.
    ASSERT_TRUE(
        write_text_file(path("bin/ffmpeg"), "#!/bin/sh\nfor last; do :; done\necho film > \"$last\"\n"));
    std::filesystem::permissions(path("bin/ffmpeg"), std::filesystem::perms::owner_all);
    ASSERT_EQ(turn("turn.mp4", own_path).exit_code, 0);
    EXPECT_EQ(*read_text_file(path("turn.mp4")), "film\n");
    EXPECT_FALSE(std::filesystem::exists(path("turn.mp4.frames")));
}
