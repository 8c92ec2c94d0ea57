// Unnamed namespaces of one library or program must not define the same name: the compiler is given eight of
// its files at a time (cmake/Dermis.cmake), and which eight depends on the list of files. Names are read from
// the text, which clang-format keeps in one shape: what an unnamed namespace defines begins at the left edge.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "test_paths.h"

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

namespace {

// "(const Image& image, int side = 3)" to "(const Image&, int)": overloads may share a name.
std::string parameter_types(const std::string& parameters) {
    std::string types = std::regex_replace(parameters, std::regex(R"( = [^,)]*)"), "");
    types = std::regex_replace(types, std::regex(R"(([\w>&*\]]) ?\b\w+(?=[,)]))"), "$1");
    return std::regex_replace(types, std::regex(R"(\s+)"), " ");
}

// Types and constants by name; functions by name and the types of their parameters.
std::set<std::string> names_in_unnamed(const std::string& source) {
    static const std::regex type(R"((?:struct|class|enum class|enum|union) (\w+)(?: final)?(?: :.*)? \{.*)"),
        function(R"([\w:<>,&*\s]*?[\s&*](\w+)(\(.*\)).*\{.*)"),
        constant(R"((?:inline |static )?const(?:expr)? [\w:<>,&*\s]*?[\s&*](\w+)(?:\[.*\])?(?: =|\{).*)");
    std::set<std::string> names;
    std::istringstream lines(source);
    std::string space;
    bool inside = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("namespace dermis::")) space = line.substr(10, line.find(" {") - 10) + "::";
        if (line == "namespace {") inside = true;
        if (line == "}  // namespace") inside = false;
        if (!inside || line.empty() || std::string(" }#/").find(line[0]) != std::string::npos) continue;
        // A list of parameters that goes over several lines.
        for (std::string more; line.ends_with(",") && std::getline(lines, more);) line += more;
        if (std::smatch found; std::regex_match(line, found, type) || std::regex_match(line, found, constant))
            names.insert(space + found[1].str());
        else if (std::regex_match(line, found, function) && found[1] != "main")  // of a shader in a string
            names.insert(space + found[1].str() + parameter_types(found[2]));
    }
    return names;
}

/// "NAME: FILE, FILE" for each name of more than one file.
std::vector<std::string> clashes(const std::map<std::string, std::string>& sources) {
    std::map<std::string, std::vector<std::string>> files_of;
    for (const auto& [file, source] : sources)
        for (const std::string& name : names_in_unnamed(source)) files_of[name].push_back(file);
    std::vector<std::string> found;
    for (const auto& [name, files] : files_of) {
        if (files.size() < 2) continue;
        found.push_back(name + ":");
        for (const std::string& file : files) found.back() += " " + file;
    }
    return found;
}

// "dermis/optics", "tests/render" for techniques/wrap/wrap_test.cpp; "" for what is compiled file by file.
std::string target_of(const std::string& path) {
    const bool test = path.ends_with("_test.cpp");
    if (path.starts_with("techniques/")) return test ? "tests/render" : "";
    if (path.starts_with("subjects/")) return test ? "tests/scene" : "";
    if (path.starts_with("tests/fuzz/") || path.starts_with("tests/consumer/")) return "";
    if (path.starts_with("apps/cli/absent/")) return "";  // instead of a file of the same names
    return path.substr(0, path.find('/', path.find('/') + 1));
}

std::string unnamed(const std::string& text) {
    return "namespace {\n\n" + text + "\n}  // namespace\n";
}

}  // namespace

TEST(UnnamedNames, differ_within_a_library_or_program) {
    // By library or program: its folder, and the tests that lie beside what they test.
    std::map<std::string, std::map<std::string, std::string>> sources;
    size_t names = 0;
    for (const char* tree : {"dermis", "tests", "apps", "techniques", "subjects"})
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(DERMIS_SOURCE_DIR) / tree)) {
            const std::string path = fs::relative(entry.path(), DERMIS_SOURCE_DIR).string();
            const std::string target = target_of(path);
            if (entry.path().extension() != ".cpp" || target.empty()) continue;
            std::ifstream file(entry.path());
            std::string& text = sources[target][path];
            text.assign(std::istreambuf_iterator<char>(file), {});
            names += names_in_unnamed(text).size();
        }
    EXPECT_TRUE(sources["tests/render"].contains("techniques/lambert/lambert_test.cpp"));
    EXPECT_TRUE(sources["apps/cli"].contains("apps/cli/commands/render.cpp"));
    for (const auto& [target, files] : sources) EXPECT_THAT(clashes(files), IsEmpty()) << target;
    EXPECT_GT(names, 1000u);
}

TEST(UnnamedNames, of_two_files_that_clash_are_found_and_overloads_are_not) {
    EXPECT_THAT(clashes({{"a.cpp", unnamed("constexpr int kRuns = 3;\nstruct Row {\n    int a;\n};")},
                         {"b.cpp", unnamed("constexpr double kRuns = 3;\nstruct Row {};")}}),
                ElementsAre("Row: a.cpp b.cpp", "kRuns: a.cpp b.cpp"));
    EXPECT_THAT(
        clashes({{"a.cpp", unnamed("int pack(const Row& row,\n         int count) {\n    return 0;\n}")},
                 {"b.cpp", unnamed("int pack(const Row& other, int n = 2) {\n    return 1;\n}")}}),
        ElementsAre("pack(const Row&, int): a.cpp b.cpp"));
    EXPECT_THAT(clashes({{"a.cpp", unnamed("int pack(const Row& row) {\n    return 0;\n}")},
                         {"b.cpp", unnamed("int pack(const Column& row) {\n    return 1;\n}")}}),
                IsEmpty());
    const std::string runs = unnamed("constexpr int kRuns = 3;");
    EXPECT_THAT(clashes({{"a.cpp", "constexpr int kRuns = 3;\n"}, {"b.cpp", runs}}), IsEmpty());
    EXPECT_THAT(clashes({{"a.cpp", runs}, {"b.cpp", "namespace dermis::gltf {\n" + runs}}), IsEmpty());
}
