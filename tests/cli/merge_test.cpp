// dermis reference --sample-range and dermis merge as a user runs them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "cli/run_program.h"
#include "support/temporary_directory.h"

using namespace dermis;
using testing::HasSubstr;

namespace {

namespace fs = std::filesystem;

class Merge : public testing::Test {
  protected:
    ProgramResult dermis(const std::string& arguments) {
        return run_shell("cd " + directory_.path.string() + " && " DERMIS_PROGRAM " " + arguments,
                         directory_.path.string());
    }
    void expect_success(const std::string& arguments) {
        const ProgramResult result = dermis(arguments);
        EXPECT_EQ(result.exit_code, 0) << arguments << ": " << result.err;
    }
    void expect_error(const std::string& arguments, const std::string& message) {
        const ProgramResult result = dermis(arguments);
        EXPECT_EQ(result.exit_code, 1) << arguments;
        EXPECT_THAT(result.err, HasSubstr(message)) << arguments;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    }
    std::string content(const std::string& name) { return slurp((directory_.path / name).string()); }

    TemporaryDirectory directory_;
};

constexpr const char* kPicture = "reference spheres --size 12x12 --samples 16 --probes 6 ";

}  // namespace

TEST_F(Merge, parts_give_the_bytes_of_one_run) {
    expect_success(std::string(kPicture) + "-o one.exr --preview one.png");
    for (const char* range : {"0:4", "4:12", "12:16"})
        expect_success(kPicture + std::string("--sample-range ") + range + " -o part_" + range + ".exr");
    expect_success("merge part_12:16.exr part_0:4.exr part_4:12.exr -o all.exr --preview all.png");
    ASSERT_FALSE(content("one.exr").empty());
    EXPECT_TRUE(content("all.exr") == content("one.exr"));
    EXPECT_TRUE(content("all.png") == content("one.png"));
    expect_success("merge --check part_0:4.exr part_4:12.exr");
    expect_error(
        "merge part_0:4.exr part_12:16.exr -o hole.exr",
        "samples 4:12 of 0:16 are in no part; run: dermis reference spheres --size 12x12 --samples 16 "
        "--probes 6 --sample-range 4:12 -o FILE.exr");
    expect_error("merge one.exr -o none.exr", "one.exr is not a part of a picture");
    expect_error("merge part_0:4.exr -o /proc/none.exr", "/proc/none.exr");
    fs::resize_file(directory_.path / "part_4:12.exr", 700);
    expect_error("merge --check part_0:4.exr part_4:12.exr", "part_4:12.exr");
    EXPECT_FALSE(fs::exists(directory_.path / "hole.exr"));
    EXPECT_FALSE(fs::exists(directory_.path / "none.exr"));
}

TEST_F(Merge, a_part_that_is_stopped_leaves_no_file) {
    const ProgramResult stopped = dermis(
        "reference spheres --size 64x64 --samples 65536 --sample-range 0:65536 -o part.exr & "
        "worker=$!; sleep 1; kill -TERM $worker; wait $worker");
    EXPECT_EQ(stopped.exit_code, 128 + 15);
    EXPECT_THAT(stopped.err, HasSubstr("nothing is written; run the same command again"));
    for (const auto& entry : fs::directory_iterator(directory_.path))
        EXPECT_FALSE(entry.path().filename().string().find("part") != std::string::npos) << entry.path();
}

TEST_F(Merge, ranges_that_are_none_are_refused_before_the_work) {
    const std::string part = "-o part.exr --sample-range ";
    expect_error(kPicture + part + "0:3", "multiples of four within 0:16 (--samples)");
    expect_error(kPicture + part + "8:4", "multiples of four");
    expect_error(kPicture + part + "0:20", "multiples of four");
    expect_error(kPicture + part + "4", "write BEGIN:END, such as 0:16");
    expect_error(kPicture + part + "0:4:8", "write BEGIN:END, such as 0:16");
    expect_error(kPicture + part + "0:8 --preview part.png", "dermis merge --preview makes it");
    expect_error("reference spheres --noise 0.1 " + part + "0:8", "leave out --noise");
    expect_error("reference spheres --samples 10 " + part + "0:8", "whole blocks of four samples");
    expect_error("reference spheres -o part.png --sample-range 0:8", "name a .exr file");
    expect_error("merge part.exr", "-o is missing");
    expect_error("merge part.exr --check -o all.exr", "--check writes nothing");
}
