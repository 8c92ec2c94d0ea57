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
    int last_thread = 200;
};

void PrintTo(const Case& one, std::ostream* out) {
    *out << one.name;
}

// Embree's thread pool ends the program when a thread after the first fails; Dermis asks for one before it.
constexpr int kRays = 1;

// Of the commands that need no GPU: a driver does not survive a failing allocation.
constexpr Case kCases[] = {
    {"bake_lut", "bake lut --size 32x32 -o out/a.exr", "out/a.exr", "out/a.exr.json"},
    {"bake_png", "bake lut --size 32x32 --storage 8 -o out/a.png", "out/a.png", "out/a.png.json"},
    {"plot", "bake lut --size 16x16 -o out/a.exr --plot out/a.svg", "out/a.svg"},
    {"profile", "profile show gpu_gems_3"},
    {"info", "info cube.obj", nullptr, nullptr, kRays},
    {"reference", "reference scene.toml --size 8x8 --samples 2 --probes 2 -o out/a.exr", "out/a.exr", nullptr,
     kRays},
    {"part", "reference scene.toml --size 8x8 --samples 8 --probes 2 --sample-range 4:8 -o out/a.exr",
     "out/a.exr", nullptr, kRays},
};

constexpr const char* kCube =
    "v 0 0 0\nv 9 0 0\nv 9 9 0\nv 0 9 0\nv 0 0 9\nv 9 0 9\nv 9 9 9\nv 0 9 9\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

struct Outcome {
    ProgramResult result;
    bool hit = false;
};

int error_lines(const std::string& text) {
    int lines = 0;
    for (size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
        lines += text.compare(at, 16, "dermis: warning:") != 0;
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
            run_shell("cd " + root + "/work && DERMIS_CACHE=" + root + "/cache DERMIS_FAULT=" + fault +
                          " DERMIS_FAULT_HIT=" + root +
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
    // Whether the call was reached.
    bool try_fault(const std::string& fault) {
        const Outcome outcome = run(fault);
        SCOPED_TRACE(fault + ": exit " + std::to_string(outcome.result.exit_code) + " " + outcome.result.err);
        EXPECT_TRUE(outcome.result.exit_code == 0 || outcome.result.exit_code == 1 ||
                    outcome.result.exit_code == 2);
        if (outcome.result.exit_code != 0) {
            EXPECT_EQ(error_lines(outcome.result.err), 1);
            const std::string made = output();
            if (GetParam().sidecar) {
                EXPECT_EQ(made.empty(), !fs::exists(directory_.path / "work" / GetParam().sidecar))
                    << "half of a result";
            }
            EXPECT_TRUE(made.empty() || made == whole_) << "half of " << GetParam().output;
        } else {
            EXPECT_TRUE(output() == whole_) << "exit 0, but " << GetParam().output << " is another";
        }
        expect_no_part_files();
        return outcome.hit;
    }

    TemporaryDirectory directory_;
    std::string whole_;
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
    int hits = 0;
    for (int call = 1; call <= GetParam().last_thread && try_fault("thread:" + std::to_string(call)); ++call)
        ++hits;
    for (const char* kind : {"open", "read", "write", "sync", "rename"})
        for (int call = 1;
             call <= (all_of_them() ? 200 : 3) && try_fault(kind + (":" + std::to_string(call))); ++call)
            ++hits;
    const double growth = all_of_them() ? 1.08 : 3;
    for (double call = 1; try_fault("memory:" + std::to_string(long(call))); call = std::ceil(call * growth))
        ++hits;
    EXPECT_GT(hits, 6);
}

INSTANTIATE_TEST_SUITE_P(Commands, Faults, testing::ValuesIn(kCases),
                         [](const auto& one) { return std::string(one.param.name); });
