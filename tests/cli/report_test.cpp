// dermis report: the text for a fault report.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "cli/run_program.h"
#include "support/temporary_directory.h"

using namespace dermis;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;

namespace {

ProgramResult report(const std::string& environment = "") {
    const TemporaryDirectory directory;
    return run_shell(environment + " " DERMIS_PROGRAM " report", directory.path.string());
}

std::string line_of(const std::string& text, const std::string& key) {
    const size_t at = text.find(key + ":");
    return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
}

}  // namespace

TEST(Report, names_version_compiler_system_device_and_driver) {
    const TemporaryDirectory directory;
    const ProgramResult result = report(),
                        version = run_shell(DERMIS_PROGRAM " --version", directory.path.string());
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr(version.out.substr(0, version.out.find('\n'))));
    EXPECT_THAT(line_of(result.out, "version"), MatchesRegex(".*(GCC|clang) [0-9]+\\.[0-9].*"));
    EXPECT_THAT(line_of(result.out, "system"), HasSubstr("Linux"));
    EXPECT_THAT(line_of(result.out, "device"),
                MatchesRegex("device: .+; .+; Vulkan 1\\.[0-9]+\\.[0-9]+; MSAA 1 .*; (pushed "
                             "descriptors|descriptor sets from a pool)"));
    EXPECT_THAT(line_of(result.out, "scenes"), HasSubstr(" spheres"));
}

// Chromium's driver, without VK_KHR_push_descriptor.
TEST(Report, lists_swiftshader_as_usable_with_descriptor_sets_from_a_pool) {
    const std::string manifest = "/usr/lib/chromium/vk_swiftshader_icd.json";
    if (!std::filesystem::exists(manifest)) GTEST_SKIP() << "no " << manifest << " (Debian: chromium)";
    const ProgramResult result = report("VK_DRIVER_FILES=" + manifest + " VK_ICD_FILENAMES=" + manifest);
    EXPECT_THAT(line_of(result.out, "device"), HasSubstr("SwiftShader driver 5."));
    EXPECT_THAT(line_of(result.out, "device"), HasSubstr("; descriptor sets from a pool"));
    EXPECT_THAT(result.out, Not(HasSubstr("  lacks:")));
}

TEST(Report, names_the_packages_that_dpkg_has) {
    if (!has_program("dpkg-query")) GTEST_SKIP() << "no dpkg here";
    const std::string line = line_of(report().out, "packages");
    EXPECT_THAT(line, MatchesRegex(".*libvulkan1 ([0-9]|\\(not installed\\)).*"));
    EXPECT_THAT(line, HasSubstr(", fonts-dejavu-core "));
}

TEST(Report, is_made_on_a_machine_without_a_driver_git_or_dpkg) {
    const ProgramResult result = report("VK_ICD_FILENAMES=/none VK_DRIVER_FILES=/none PATH=/none");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(line_of(result.out, "device"), HasSubstr("none: "));
    EXPECT_THAT(line_of(result.out, "packages"), HasSubstr("unknown"));
    EXPECT_THAT(line_of(result.out, "variables"), HasSubstr("VK_ICD_FILENAMES=/none"));
}
