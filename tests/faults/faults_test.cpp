// Every call for memory, files and threads fails in turn: a command ends with one line and exit 1, and leaves
// either the whole result or nothing. A sample by default; DERMIS_FAULTS=all tries each call (memory: about a
// hundred places spread over the run).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>

#include "cli/run_program.h"
#include "dermis/base/file.h"
#include "faults/cases.h"
#include "support/moving_sheet.h"
#include "support/temporary_directory.h"
#include "view/display.h"

using namespace dermis;

namespace {

namespace fs = std::filesystem;

constexpr const char* kCube =
    "v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nv 0 0 9\nv 9 0 9\nv 9 9 9\nv 0 9 9\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "f 1/1 4/2 3/3 2/4\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

using Files = std::map<std::string, std::string>;  // of out/, by their paths there

struct Outcome {
    ProgramResult result;
    bool hit = false;
};

// The shell adds a line of its own after a signal; a driver's library says what it failed at before it ends
// the program, and Xlib ends it itself, with two lines.
int error_lines(const std::string& text, bool draws) {
    const bool by_a_library =
        draws && text.find("dermis: a library ended the program (SIGABRT)") != std::string::npos;
    int lines = 0;
    for (size_t at = 0; at < text.size(); at = text.find('\n', at) + 1) {
        const auto begins = [&](std::string_view with) { return text.compare(at, with.size(), with) == 0; };
        if (begins("dermis: warning:") || begins("Segmentation") || begins("Floating point")) continue;
        if (draws && begins("      after ")) continue;  // the second line of Xlib's
        lines += !by_a_library || begins("dermis:");
    }
    return lines;
}

class Faults : public testing::TestWithParam<Case> {
  protected:
    static void SetUpTestSuite() { display_ = std::make_unique<VirtualDisplay>("320x200"); }
    static void TearDownTestSuite() { display_.reset(); }

    std::string in_folder(const fs::path& folder) const {
        return "cd " + folder.string() + " && timeout -s KILL " + (draws() ? "30" : "120") +
               " env DISPLAY=" + display_->name() + " DERMIS_CACHE=" + (directory_.path / "cache").string() +
               " XDG_STATE_HOME=" + (directory_.path / "state").string() + " ";
    }
    // What each run begins with, in a folder that is copied.
    void prepare() {
        const fs::path start = directory_.path / "start";
        fs::create_directories(start);
        std::ofstream(start / "cube.obj") << kCube;
        std::ofstream(start / "scene.toml") << "[[mesh]]\nfile = \"cube.obj\"\nunit_mm = 1\n";
        std::ofstream(start / "sheet.gltf") << test::moving_sheet();
        std::ofstream(start / "commands.txt")
            << "reference scene.toml --size 8x8 --samples 16 --probes 6 -o out/picture.exr\n";
        if (!GetParam().prepare) return;
        const ProgramResult made =
            run_shell(in_folder(start) + "DERMIS=" DERMIS_PROGRAM " sh -c '" + GetParam().prepare + "'",
                      directory_.path.string());
        ASSERT_EQ(made.exit_code, 0) << made.err;
    }
    Outcome run(const std::string& fault) {
        for (const char* left : {"work", "state", "hit"}) fs::remove_all(directory_.path / left);
        if (GetParam().kind != Case::slow) fs::remove_all(directory_.path / "cache");
        const fs::path work = directory_.path / "work";
        fs::copy(directory_.path / "start", work, fs::copy_options::recursive);
        Outcome outcome;
        outcome.result =
            run_shell(in_folder(work) + "DERMIS_FAULT=" + fault +
                          " DERMIS_FAULT_HIT=" + (directory_.path / "hit").string() +
                          " LD_PRELOAD=" DERMIS_FAULT_SHIM " " DERMIS_PROGRAM " " + GetParam().arguments,
                      directory_.path.string());
        outcome.hit = fs::exists(directory_.path / "hit");
        return outcome;
    }
    static bool draws() { return GetParam().kind == Case::draws; }
    Files made() const {
        Files files;
        const fs::path out = directory_.path / "work/out";
        if (!fs::exists(out)) return files;
        for (const auto& entry : fs::recursive_directory_iterator(out))
            if (entry.is_regular_file())
                files[entry.path().lexically_relative(out).string()] = slurp(entry.path().string());
        return files;
    }
    void expect_no_part_files() {
        for (const auto& entry : fs::recursive_directory_iterator(directory_.path))
            EXPECT_EQ(entry.path().filename().string().find(".part"), std::string::npos) << entry.path();
    }
    void expect_whole_or_none() {
        if (GetParam().made == Made::varies) return;
        const Files files = made();
        for (const auto& [path, content] : files) {
            const auto found = whole_.find(path);
            EXPECT_TRUE(found != whole_.end() && found->second == content) << "half of " << path;
        }
        if (GetParam().made == Made::together) {
            EXPECT_TRUE(files.empty() || files.size() == whole_.size()) << "half of a result";
        }
    }
    // Whether the call was reached.
    bool try_fault(const std::string& fault) {
        const Outcome outcome = run(fault);
        tried_ += outcome.hit;
        SCOPED_TRACE(fault + ": exit " + std::to_string(outcome.result.exit_code) + " " + outcome.result.err);
        if (draws() && outcome.result.exit_code == 137) {
            ++hangs_;
            expect_whole_or_none();
            return outcome.hit;
        }
        const bool crashed = draws() && outcome.result.err.find("dermis: crashed (SIG") != std::string::npos;
        crashes_ += crashed;
        EXPECT_TRUE(crashed || (outcome.result.exit_code >= 0 && outcome.result.exit_code <= 2));
        if (outcome.result.exit_code != 0) {
            EXPECT_EQ(error_lines(outcome.result.err, draws()), 1);
            expect_whole_or_none();
        } else if (GetParam().made != Made::varies) {
            EXPECT_TRUE(made() == whole_) << "exit 0, but the result is another";
        }
        expect_no_part_files();
        return outcome.hit;
    }

    TemporaryDirectory directory_;
    Files whole_;
    int tried_ = 0, crashes_ = 0,
        hangs_ = 0;  ///< calls that were reached; those after which a driver crashed or waited for ever
    inline static std::unique_ptr<VirtualDisplay> display_;
};

bool all_of_them() {
    const char* text = std::getenv("DERMIS_FAULTS");
    return text && std::string(text) == "all";
}

std::vector<Case> cases() {
    std::vector<Case> chosen;
    std::ranges::copy_if(kCases, std::back_inserter(chosen),
                         [](const Case& one) { return !one.takes_seconds || all_of_them(); });
    return chosen;
}

}  // namespace

TEST_P(Faults, end_with_one_line_and_nothing_half_written) {
    if (std::string(GetParam().name) == "view" && display_->name().empty())
        GTEST_SKIP() << "no Xvfb; apt-get install xvfb";
    ASSERT_NO_FATAL_FAILURE(prepare());
    const Outcome good = run("none:0");
    ASSERT_EQ(good.result.exit_code, 0) << good.result.err;
    whole_ = made();
    const bool few = GetParam().kind != Case::quick && !all_of_them();  // a run of them is long
    const int threads = few ? 3 : 200, files = all_of_them() ? 200 : few ? 1 : 3;
    for (int call = 1; call <= threads && try_fault("thread:" + std::to_string(call)); ++call) {
    }
    for (const char* kind : {"open", "read", "write", "sync", "rename"})
        for (int call = 1; call <= files && try_fault(kind + (":" + std::to_string(call))); ++call) {
        }
    const double growth = all_of_them() ? 1.08 : few ? 8 : 3;
    for (double call = 1; try_fault("memory:" + std::to_string(long(call)));
         call = std::ceil(call * growth)) {
    }
    EXPECT_GT(tried_, 6);
    std::printf("%s: %d calls failed in turn\n", GetParam().name, tried_);
    if (draws())
        std::printf("of these the driver crashed after %d, with the line, and hung after %d\n", crashes_,
                    hangs_);
}

INSTANTIATE_TEST_SUITE_P(Commands, Faults, testing::ValuesIn(cases()),
                         [](const auto& one) { return std::string(one.param.name); });
