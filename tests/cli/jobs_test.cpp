// dermis jobs as a user runs it: on this machine, with workers killed, with GNU parallel and on a real Slurm.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "cli/run_program.h"
#include "support/moving_sheet.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

namespace fs = std::filesystem;

constexpr const char* kJobsPicture = "reference spheres --size 16x16 --samples 28 --probes 6 ";

class Jobs : public testing::Test {
  protected:
    ProgramResult shell(const std::string& line) {
        return run_shell("cd " + directory_.path.string() + " && " + line, directory_.path.string());
    }
    void expect_success(const std::string& line) {
        const ProgramResult result = shell(line);
        EXPECT_EQ(result.exit_code, 0) << line << ": " << result.err;
    }
    void expect_error(const std::string& commands, const std::string& message,
                      const std::string& options = "") {
        file("wrong.txt", commands);
        const ProgramResult result = shell(DERMIS_PROGRAM " jobs wrong.txt " + options);
        EXPECT_EQ(result.exit_code, 1) << commands;
        EXPECT_THAT(result.err, HasSubstr(message)) << commands;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_FALSE(fs::exists(directory_.path / "out")) << commands;
    }
    void file(const std::string& name, const std::string& text) {
        std::ofstream(directory_.path / name) << text;
        fs::permissions(directory_.path / name, fs::perms::owner_all);
    }
    std::string content(const std::string& name) { return slurp((directory_.path / name).string()); }
    // commands.txt, and the picture by one run as one.exr.
    void write_commands() {
        file("commands.txt", "\xef\xbb\xbf# one picture\n\ndermis " + std::string(kJobsPicture) +
                                 "-o 'out/a b.exr' --preview out/a.png\n");
        expect_success(DERMIS_PROGRAM " " + std::string(kJobsPicture) + "-o one.exr --preview one.png");
    }
    void expect_the_picture() {
        ASSERT_FALSE(content("one.exr").empty());
        EXPECT_TRUE(content("out/a b.exr") == content("one.exr"));
        EXPECT_TRUE(content("out/a.png") == content("one.png"));
    }

    TemporaryDirectory directory_;
};

}  // namespace

TEST_F(Jobs, workers_that_are_killed_at_random_change_nothing) {
    write_commands();
    // Ends dermis after a time that the range of samples decides, in up to two of three attempts.
    file("killed",
         "#!/bin/sh\n"
         "case \"$*\" in *--sample-range*) ;; *) exec " DERMIS_PROGRAM
         " \"$@\" ;; esac\n"
         "key=$(echo \"seed 20 ${*##*--sample-range}\" | sed 's/ -o .*//' | cksum | cut -d' ' -f1)\n"
         "echo attempt >> attempts.$key\n" DERMIS_PROGRAM
         " \"$@\" & worker=$!\n"
         "if [ $(wc -l < attempts.$key) -le $((key % 3)) ]; then\n"
         "    sleep 0.0$((key / 3 % 9))\n"
         "    kill -9 $worker\n"
         "fi\n"
         "wait $worker\n");
    const ProgramResult result =
        shell(DERMIS_PROGRAM " jobs commands.txt --parts 7 --runner local --program ./killed");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("8 jobs done, "));
    EXPECT_THAT(result.out, testing::Not(HasSubstr("done, 0 repeated")));
    expect_the_picture();
}

TEST_F(Jobs, a_damaged_part_is_made_again_and_no_other) {
    write_commands();
    const std::string run = DERMIS_PROGRAM " jobs commands.txt --folder out/jobs --parts 3 --runner local";
    expect_success(run);
    const std::string whole = shell("ls out/jobs/parts/*_0_8.exr").out;
    const auto made = fs::last_write_time(directory_.path / whole.substr(0, whole.size() - 1));
    expect_success("rm 'out/a b.exr' && truncate -s 900 out/jobs/parts/*_8_16.exr");
    expect_success(run);
    expect_the_picture();
    EXPECT_EQ(fs::last_write_time(directory_.path / whole.substr(0, whole.size() - 1)), made);
    // Parts that a picture does not need any more.
    expect_success("rm out/jobs/parts/* && " + run + " && [ -z \"$(ls out/jobs/parts)\" ]");
}

TEST_F(Jobs, a_picture_that_was_emptied_is_made_again_and_nothing_written_is_nothing_done) {
    write_commands();
    const std::string run = DERMIS_PROGRAM " jobs commands.txt --folder out/jobs --parts 2 --runner local";
    const ProgramResult nothing = shell(run + " --program /bin/true");
    EXPECT_EQ(nothing.exit_code, 1);
    EXPECT_THAT(nothing.err, HasSubstr("no whole result: out/jobs/parts/"));
    EXPECT_EQ(nothing.out, "");
    expect_success(run);
    for (const char* damage : {": > 'out/a b.exr'", "truncate -s 900 out/a.png"}) {
        expect_success(damage);
        expect_success(run);
        expect_the_picture();
    }
}

TEST_F(Jobs, a_line_that_fails_says_why_and_the_others_are_done) {
    file("commands.txt",
         "reference spheres --size 8x8 --samples 8 -o out/a.exr\nreference spheres --size 8x8 --samples 8 "
         "--seed 2 -o out/b.exr\n");
    file("failing",
         "#!/bin/sh\ncase \"$*\" in *'--seed 2'*0:4*) echo 'dermis: no disk' >&2; exit 1 ;; "
         "esac\nexec " DERMIS_PROGRAM " \"$@\"\n");
    const std::string run = " jobs commands.txt --folder out/jobs --parts 2 --runner local";
    const ProgramResult result = shell(DERMIS_PROGRAM + run + " --program ./failing");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("out/b.exr samples 0:4: dermis: no disk"));
    EXPECT_EQ(shell("ls out/jobs/parts | wc -l").out, "3\n");
    expect_success(DERMIS_PROGRAM + run);
    EXPECT_TRUE(fs::exists(directory_.path / "out/b.exr"));
}

TEST_F(Jobs, frames_and_comparisons_are_lines_too) {
    file("commands.txt",
         "render spheres -t lambert --frames 5 --turn 360 -o out/turn/%04d.png\n"
         "compare spheres --techniques lambert -o out/compare\n"
         "render spheres -o out/still.png\n");
    const ProgramResult result = shell(DERMIS_PROGRAM " jobs commands.txt --parts 2 --program dermis");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const std::string work = content("out/jobs/work.txt");
    EXPECT_EQ(std::count(work.begin(), work.end(), '\n'), 4);
    EXPECT_THAT(work, HasSubstr("-o out/turn/%04d.png --frame-range 0:2 && "));
    EXPECT_THAT(work, HasSubstr("cksum out/turn/0002.png out/turn/0003.png out/turn/0004.png 2>/dev/null"));
    EXPECT_THAT(work, HasSubstr("cksum out/compare/scores.csv out/compare/regions.csv 2>/dev/null"));
    EXPECT_THAT(
        work, HasSubstr("{ dermis render spheres -o out/still.png && cksum out/still.png > out/jobs/done/"));
    // The hash is of the content.
    shell("sed -i 's/lambert -o/wrap -o/' commands.txt && " DERMIS_PROGRAM
          " jobs commands.txt --parts 2 --program dermis");
    EXPECT_NE(content("out/jobs/work.txt"), work);
}

TEST_F(Jobs, frames_of_a_compared_clip_are_those_of_one_run) {
    file("sheet.gltf", test::moving_sheet());
    const std::string command =
        "compare sheet.gltf -t lambert,wrap --clip nod --time 0.5 --frames 3 --fps 2 --size 32x32 --samples "
        "64 "
        "--samples-per-pixel 4 --noise 1 --timed-frames 1 --integrator walk -o ";
    file("commands.txt", command + "out/clip\n");
    expect_success("DERMIS_CACHE=one " DERMIS_PROGRAM " " + command + "out/one");
    expect_success("DERMIS_CACHE=two " DERMIS_PROGRAM " jobs commands.txt --parts 2 --runner local");
    const std::string work = content("out/jobs/work.txt"), merge = content("out/jobs/merge.txt");
    EXPECT_EQ(std::count(work.begin(), work.end(), '\n'), 2);
    EXPECT_THAT(work, HasSubstr("-o out/clip --frame-range 1:3 && cksum out/clip/frame_01/report.html"));
    EXPECT_EQ(std::count(merge.begin(), merge.end(), '\n'), 1);
    EXPECT_NE(content("out/one/clip.csv"), "");
    EXPECT_EQ(content("out/clip/clip.csv"), content("out/one/clip.csv"));
    // A range alone leaves the files of all frames as they are.
    expect_success("rm out/clip/*.csv && DERMIS_CACHE=two " DERMIS_PROGRAM " " + command +
                   "out/clip --frame-range 1:2");
    EXPECT_FALSE(fs::exists(directory_.path / "out/clip/clip.csv"));
    for (const std::string range : {"1:1", "0:4", "2", "2:1"})
        EXPECT_THAT(shell(DERMIS_PROGRAM " " + command + "out/clip --frame-range " + range).err,
                    HasSubstr("--frame-range"));
}

TEST_F(Jobs, what_is_no_job_is_refused_with_its_line) {
    expect_error("", "wrong.txt: no line has a command");
    expect_error("reference spheres --noise 0.1 -o a.exr\n",
                 "wrong.txt:1: a range needs a fixed number of samples");
    expect_error("\nreference spheres --samples 16 --sample-range 0:4 -o a.exr\n",
                 "wrong.txt:2: --sample-range: dermis jobs chooses");
    expect_error("render spheres --frames 4 --frame-range 0:1 -o %d.png\n",
                 "--frame-range: dermis jobs chooses");
    expect_error("bake lut -o a.exr\n", "'bake' is not split into jobs: write reference, compare or render");
    expect_error("rendr spheres\n", "did you mean 'render'?");
    expect_error("render spheres --sise 4\n", "wrong.txt:1: ");
    expect_error("render --help\n", "wrong.txt:1: asks for help");
    expect_error("render spheres > a\n", "'>' needs a shell");
    expect_error("render spheres -o a.png\n", "did you mean 'local'?", "--runner locl");
    expect_error("render spheres -o a.png\n", "/proc/x: cannot make the directory", "--folder /proc/x");
}

TEST_F(Jobs, gnu_parallel_runs_the_lists) {
    if (!has_program("parallel")) GTEST_SKIP() << "no parallel here: apt-get install parallel";
    write_commands();
    expect_success(DERMIS_PROGRAM " jobs commands.txt --parts 3");
    expect_success(
        "parallel --will-cite -j2 < out/jobs/work.txt && parallel --will-cite < out/jobs/merge.txt");
    expect_the_picture();
}

TEST_F(Jobs, slurm_runs_them_on_one_node_with_two_tasks) {
    const ProgramResult result = shell(DERMIS_SOURCE_DIR "/tools/checks/slurm " DERMIS_PROGRAM);
    if (result.exit_code == 77) GTEST_SKIP() << result.out;
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
}
