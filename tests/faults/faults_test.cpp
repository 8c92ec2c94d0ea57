// Every call for memory, files and threads fails in turn: a command ends with one line and exit 1, and leaves
// either the whole result or nothing. A sample by default; DERMIS_FAULTS=all tries each call (memory: about a
// hundred places spread over the run).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "cli/run_program.h"
#include "dermis/base/file.h"
#include "support/temporary_directory.h"

using namespace dermis;

namespace {

namespace fs = std::filesystem;

struct Case {
    const char* name;
    const char* arguments;
    const char* output = nullptr;   ///< the file that it makes
    const char* sidecar = nullptr;  ///< and one beside it
    bool draws = false;             ///< by Vulkan: a driver may crash on a failing allocation
};

void PrintTo(const Case& one, std::ostream* out) {
    *out << one.name;
}

constexpr Case kCases[] = {
    {"bake_lut", "bake lut --size 32x32 -o out/a.exr", "out/a.exr", "out/a.exr.json"},
    {"bake_png", "bake lut --size 32x32 --storage 8 -o out/a.png", "out/a.png", "out/a.png.json"},
    {"plot", "bake lut --size 16x16 -o out/a.exr --plot out/a.svg", "out/a.svg"},
    {"profile", "profile show gpu_gems_3"},
    {"info", "info cube.obj"},
    {"info_json", "info cube.obj --json"},
    {"reference", "reference scene.toml --size 8x8 --samples 2 --probes 2 -o out/a.exr", "out/a.exr"},
    {"part", "reference scene.toml --size 8x8 --samples 8 --probes 2 --sample-range 4:8 -o out/a.exr",
     "out/a.exr"},
    {"bake_zh", "bake zh --size 16 -o out/a.exr", "out/a.exr", "out/a.exr.json"},
    {"export", "export --language hlsl -o out/a.hlsl", "out/a.hlsl"},
    {"passes", "passes lambert"},
    {"render", "render scene.toml --size 16x16 -o out/a.png", "out/a.png", nullptr, true},
    {"compare",
     "compare scene.toml --size 16x16 --samples 8 --samples-per-pixel 4 --frames 1 -t lambert -o out",
     nullptr, nullptr, true},
};

constexpr const char* kCube =
    "v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nv 0 0 9\nv 9 0 9\nv 9 9 9\nv 0 9 9\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

struct Outcome {
    ProgramResult result;
    bool hit = false;
};

// The shell adds a line of its own after a signal.
int error_lines(const std::string& text) {
    int lines = 0;
    for (size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
        lines += text.compare(at, 16, "dermis: warning:") != 0 && text.compare(at, 12, "Segmentation") != 0;
    return lines;
}

class Faults : public testing::TestWithParam<Case> {
  protected:
    Outcome run(const std::string& fault) {
        fs::remove_all(directory_.path);
        fs::create_directories(directory_.path / "work");
        std::ofstream(directory_.path / "work/cube.obj") << kCube;
        std::ofstream(directory_.path / "work/scene.toml") << "[[mesh]]\nfile = \"cube.obj\"\nunit_mm = 1\n";
        const std::string root = directory_.path.string();
        Outcome outcome;
        outcome.result =
            run_shell("cd " + root + "/work && timeout -s KILL 20 env DERMIS_CACHE=" + root +
                          "/cache DERMIS_FAULT=" + fault + " DERMIS_FAULT_HIT=" + root +
                          "/hit LD_PRELOAD=" DERMIS_FAULT_SHIM " " DERMIS_PROGRAM " " + GetParam().arguments,
                      root);
        outcome.hit = fs::exists(directory_.path / "hit");
        return outcome;
    }
    std::string output() {
        if (!GetParam().output) return "";
        const Result<std::string> text = read_text_file(directory_.path / "work" / GetParam().output);
        return text ? *text : "";
    }
    void expect_no_part_files() {
        for (const auto& entry : fs::recursive_directory_iterator(directory_.path))
            EXPECT_EQ(entry.path().filename().string().find(".part"), std::string::npos) << entry.path();
    }
    void expect_whole_or_none() {
        const std::string made = output();
        EXPECT_TRUE(made.empty() || made == whole_) << "half of " << GetParam().output;
    }
    // Whether the call was reached.
    bool try_fault(const std::string& fault) {
        const Outcome outcome = run(fault);
        tried_ += outcome.hit;
        SCOPED_TRACE(fault + ": exit " + std::to_string(outcome.result.exit_code) + " " + outcome.result.err);
        if (GetParam().draws && outcome.result.exit_code == 137) {
            ++hangs_;
            expect_whole_or_none();
            return outcome.hit;
        }
        const bool crashed =
            GetParam().draws && outcome.result.err.find("dermis: crashed (SIG") != std::string::npos;
        crashes_ += crashed;
        EXPECT_TRUE(crashed || (outcome.result.exit_code >= 0 && outcome.result.exit_code <= 2));
        if (outcome.result.exit_code != 0) {
            EXPECT_EQ(error_lines(outcome.result.err), 1);
            if (GetParam().sidecar) {
                EXPECT_EQ(output().empty(), !fs::exists(directory_.path / "work" / GetParam().sidecar))
                    << "half of a result";
            }
            expect_whole_or_none();
        } else {
            EXPECT_TRUE(output() == whole_) << "exit 0, but " << GetParam().output << " is another";
        }
        expect_no_part_files();
        return outcome.hit;
    }

    TemporaryDirectory directory_;
    std::string whole_;
    int tried_ = 0, crashes_ = 0,
        hangs_ = 0;  ///< calls that were reached; those after which a driver crashed or waited for ever
};

bool all_of_them() {
    const char* text = std::getenv("DERMIS_FAULTS");
    return text && std::string(text) == "all";
}

}  // namespace

TEST_P(Faults, end_with_one_line_and_nothing_half_written) {
    const Outcome good = run("none:0");
    ASSERT_EQ(good.result.exit_code, 0) << good.result.err;
    whole_ = output();
    const bool few = GetParam().draws && !all_of_them();  // a run of them is long
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
    if (GetParam().draws)
        std::printf(
            "%s: after %d failing calls the driver crashed %d times, with the line, and hung %d times\n",
            GetParam().name, tried_, crashes_, hangs_);
}

INSTANTIATE_TEST_SUITE_P(Commands, Faults, testing::ValuesIn(kCases),
                         [](const auto& one) { return std::string(one.param.name); });
