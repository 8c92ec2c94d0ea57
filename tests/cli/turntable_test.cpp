#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "cli/run_program.h"
#include "dermis/base/file.h"
#include "support/temporary_directory.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

class Turntable : public testing::Test {
  protected:
    ProgramResult turn(const std::string& output, const std::string& environment = "") {
        return run_shell(environment + " " + DERMIS_PROGRAM +
                             " view builtin:spheres --size 16x16 --samples 1 --turntable 3 -o " +
                             path(output),
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

TEST_F(Turntable, a_film_needs_ffmpeg_and_leaves_no_frames) {
    std::filesystem::create_directory(path("bin"));
    const std::string own_path = "PATH=" + path("bin");
    const ProgramResult without = turn("turn.mp4", own_path);
    EXPECT_EQ(without.exit_code, 1);
    EXPECT_THAT(without.err, HasSubstr("apt-get install ffmpeg"));
    // Stands in for ffmpeg: writes its last argument.
    ASSERT_TRUE(
        write_text_file(path("bin/ffmpeg"), "#!/bin/sh\nfor last; do :; done\necho film > \"$last\"\n"));
    std::filesystem::permissions(path("bin/ffmpeg"), std::filesystem::perms::owner_all);
    ASSERT_EQ(turn("turn.mp4", own_path).exit_code, 0);
    EXPECT_EQ(*read_text_file(path("turn.mp4")), "film\n");
    EXPECT_FALSE(std::filesystem::exists(path("turn.mp4.frames")));
}
