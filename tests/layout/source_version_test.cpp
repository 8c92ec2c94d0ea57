// cmake/SourceVersion.cmake: what a cached result is valid for changes with the code that made it, not with
// its comments.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>

#include "cli/run_program.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

using namespace dermis;

namespace {

// Of one file with this text.
std::string version_of(const std::string& text) {
    const TemporaryDirectory directory;
    const std::string folder = directory.path.string(), output = folder + "/version.cpp";
    std::ofstream(folder + "/code.cpp") << text;
    const ProgramResult made =
        run_shell("cmake -D files=" + folder + "/code.cpp -D root=" + folder +
                      " -D folder=judge -D name=reference_version -D output=" + output +
                      " -P " DERMIS_SOURCE_DIR "/cmake/SourceVersion.cmake",
                  folder);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    const std::string source = slurp(output);
    std::smatch found;
    EXPECT_TRUE(std::regex_search(source, found, std::regex("return \"([0-9a-f]{16})\""))) << source;
    return found[1];
}

}  // namespace

TEST(SourceVersion, follows_code_and_neither_comments_nor_line_breaks) {
    const std::string version = version_of("int probes = 64;  // of a sample\n");
    EXPECT_EQ(version, version_of("int probes =\n    64;  // of one sample\n"));
    EXPECT_NE(version, version_of("int probes = 32;  // of a sample\n"));
    EXPECT_NE(version, version_of("int probes = 64;\nint seed; // of a sample\n"));
}
