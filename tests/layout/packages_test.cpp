// The packages that are installed against what CMake looks for, what the sources include and what README
// names.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "packages_evidence.h"
#include "test_paths.h"

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

namespace dermis {
namespace {

const fs::path kTree = DERMIS_SOURCE_DIR;

std::string read_text(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string texts_under(const std::vector<std::string>& trees, const std::set<std::string>& extensions) {
    std::string all;
    for (const std::string& tree : trees) {
        if (fs::is_regular_file(kTree / tree)) all += read_text(kTree / tree);
        if (!fs::is_directory(kTree / tree)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(kTree / tree)) {
            const fs::path name = entry.path().filename();
            // Names in this test do not count as use.
            if (!entry.is_regular_file() || name.string().starts_with("packages_")) continue;
            if (extensions.contains(name.extension()) || extensions.contains(name))
                all += read_text(entry.path());
        }
    }
    return all;
}

PackageUse repository() {
    const std::vector<std::string> trees = {"dermis", "subjects", "techniques", "apps",
                                            "tests",  "bench",    "cmake",      "CMakeLists.txt"};
    const std::string programs =
        texts_under({"tools", "run", "test", "apps", "tests", "docs/python"}, {"", ".mjs", ".py"});
    const std::string sources = texts_under(trees, {".cpp", ".h"});
    return {.lists = read_text(kTree / "tools/packages.txt") +
                     read_text(kTree / "tools/packages_checks.txt") +
                     read_text(kTree / "tools/packages_python.txt"),
            .readme = read_text(kTree / "README.md"),
            .cmake = texts_under(trees, {".cmake", ".in", "CMakeLists.txt"}),
            .sources = sources,
            .texts = sources + programs};
}

// A small repository in which everything agrees.
PackageUse agreeing() {
    return {.lists = "# a comment\nlibpng-dev # PNG\nlibcli11-dev\n",
            .readme =
                "## Dependencies\n\n| package | why |\n|---|---|\n| libpng-dev, libcli11-dev | PNG; command "
                "line |\n\n## State\n",
            .cmake = "find_package(PNG REQUIRED)\nfind_package(Threads)\n",
            .sources = "#include <png.h>\n#include <CLI/CLI.hpp>\n#include <vector>\n#include <sys/stat.h>\n",
            .texts = ""};
}

}  // namespace

TEST(Packages, lists_and_cmake_and_includes_and_readme_agree) {
    const PackageUse use = repository();
    ASSERT_GT(listed_packages(use.lists).size(), 30u);
    ASSERT_GT(use.sources.size(), 100'000u);
    for (const std::string& text : disagreements(use)) ADD_FAILURE() << text;
}

TEST(Packages, a_small_repository_without_differences_has_no_findings) {
    EXPECT_THAT(disagreements(agreeing()), IsEmpty());
}

TEST(Packages, a_package_taken_out_of_the_list_is_missed) {
    PackageUse use = agreeing();
    use.lists = "libcli11-dev\n";
    EXPECT_THAT(disagreements(use),
                ElementsAre("CMake looks for PNG, and libpng-dev is in no list of tools/",
                            "a source includes <png.h>, and libpng-dev is in no list of tools/",
                            "README names libpng-dev, which is in no list of tools/"));
}

TEST(Packages, a_package_that_nothing_uses_is_found) {
    PackageUse use = agreeing();
    use.sources = "#include <png.h>\n";
    EXPECT_THAT(disagreements(use), ElementsAre("libcli11-dev is listed, and nothing uses it"));
    use.lists += "libstb-dev\n";
    use.readme = std::regex_replace(use.readme, std::regex("libcli11-dev"), "libcli11-dev, libstb-dev");
    EXPECT_THAT(
        disagreements(use),
        ElementsAre(
            "libcli11-dev is listed, and nothing uses it",
            "libstb-dev is listed, and kPackageEvidence of this test does not say what shows its use"));
}

TEST(Packages, a_package_that_readme_lacks_or_invents_is_found) {
    PackageUse use = agreeing();
    use.readme = std::regex_replace(use.readme, std::regex("libcli11-dev"), "libtinygltf-dev");
    EXPECT_THAT(disagreements(use),
                ElementsAre("libcli11-dev is listed, and README's table does not name it",
                            "README names libtinygltf-dev, which is in no list of tools/"));
}

TEST(Packages, what_cmake_looks_for_and_what_is_included_must_be_known) {
    PackageUse use = agreeing();
    use.cmake += "pkg_check_modules(X REQUIRED IMPORTED_TARGET ogg)\nfind_library(OGG ogg)\n";
    use.sources += "#include <ogg/ogg.h>\n";
    EXPECT_THAT(
        disagreements(use),
        ElementsAre("CMake looks for ogg: add its package to kPackageEvidence of this test",
                    "a source includes <ogg/ogg.h>: add its package to kPackageEvidence of this test"));
}

// A CMake package checks that every file of its targets exists, and some of those may be in other packages:
// libjpeg.a was. Every such file must come with what the list installs.
TEST(Packages, files_that_cmake_packages_check_come_with_the_listed_packages) {
    if (std::system("command -v dpkg-query >/dev/null") != 0) GTEST_SKIP() << "no dpkg here";
    const DebianPackages system = installed_packages();
    const std::set<std::string> listed = listed_packages(repository().lists);
    std::vector<std::string> files;
    for (const fs::path& folder : package_folders(read_text(DERMIS_BINARY_DIR "/CMakeCache.txt")))
        for (const std::string& file : checked_files(folder)) files.push_back(file);
    ASSERT_GT(files.size(), 10u);
    const std::map<std::string, std::string> owners = owners_of(files);
    if (owners.empty()) GTEST_SKIP() << "the libraries here are not Debian's";
    EXPECT_THAT(unlisted_owners(owners, with_dependencies(listed, system)), IsEmpty());
    ASSERT_THAT(files, ::testing::Contains(::testing::EndsWith("/libjpeg.a")));
    std::set<std::string> without = listed;
    without.erase("libjpeg62-turbo-dev");
    EXPECT_THAT(unlisted_owners(owners, with_dependencies(without, system)),
                ElementsAre(::testing::HasSubstr("libjpeg.a is in libjpeg62-turbo-dev")));
}

}  // namespace dermis
