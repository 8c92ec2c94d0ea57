// The documentation names files, headings, parameters of techniques, benchmarks and tests: each of them
// exists.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/docs_pages.h"
#include "cli/run_program.h"
#include "dermis/base/text.h"
#include "support/temporary_directory.h"

using namespace dermis;
using namespace dermis::docs;
using testing::Contains;
using testing::IsEmpty;

namespace {

// "dermis/render/shared_passes" names shared_passes.h and .cpp; *, NAME and my_skin are examples of names.
bool exists(const std::string& path) {
    static const std::regex example("[*<>{]|NAME|my_skin");
    if (std::regex_search(path, example)) return true;
    if (fs::exists(kRoot / path)) return true;
    const fs::path full = kRoot / path;
    if (!fs::is_directory(full.parent_path())) return false;
    return std::ranges::any_of(fs::directory_iterator(full.parent_path()), [&](const auto& entry) {
        return entry.path().stem() == full.filename() ||
               entry.path().filename().string().starts_with(full.filename().string() + ".");
    });
}

// The anchor of a heading: lower case, spaces as hyphens, without other punctuation.
std::string anchor_of(const std::string& heading) {
    std::string anchor;
    for (const char c : heading)
        if (c == ' ')
            anchor += '-';
        else if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || (c & 0x80) != 0)
            anchor += char(std::tolower(static_cast<unsigned char>(c)));
    return anchor;
}

std::set<std::string> anchors_of(const std::string& page) {
    std::set<std::string> anchors;
    bool fenced = false;
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("```")) fenced = !fenced;
        const size_t text = line.find_first_not_of('#');
        if (!fenced && text != 0 && text != std::string::npos && line[text] == ' ')
            anchors.insert(anchor_of(line.substr(text + 1)));
    }
    return anchors;
}

// The fault of a link of a page; empty when there is none.
std::string wrong_link(const fs::path& page, const std::string& link) {
    if (link.find("://") != std::string::npos) return {};
    const size_t hash = link.find('#');
    const fs::path file = hash == 0 ? page : page.parent_path() / link.substr(0, hash);
    if (!fs::exists(file)) return "no file " + file.string();
    if (hash == std::string::npos) return {};
    const std::string anchor = link.substr(hash + 1);
    return anchors_of(read(file)).contains(anchor) ? "" : "no heading #" + anchor;
}

// Every path of the repository's sources.
const std::vector<std::string>& source_files() {
    static const std::vector<std::string> kFiles = [] {
        std::vector<std::string> files;
        for (const char* tree : {"apps", "bench", "catalog", "cmake", "dermis", "scenes", "shaders",
                                 "subjects", "techniques", "tests", "tools", "engines"})
            for (const auto& entry : fs::recursive_directory_iterator(kRoot / tree))
                if (entry.is_regular_file())
                    files.push_back("/" + fs::relative(entry.path(), kRoot).string());
        return files;
    }();
    return kFiles;
}

// "weights.h" and "preintegrated/weights.h" name techniques/preintegrated/weights.h.
bool is_source(const std::string& name) {
    return std::ranges::any_of(source_files(),
                               [&](const std::string& file) { return file.ends_with("/" + name); });
}

/// Choices by parameter, over all techniques; none for a number. "preset" has the names of all presets.
using Parameters = std::map<std::string, std::set<std::string>>;

const Parameters& all_parameters() {
    static const Parameters kParameters = [] {
        TemporaryDirectory scratch;
        const std::string text =
            run_shell(std::string(DERMIS_PROGRAM) + " techniques --json", scratch.path.string()).out;
        Parameters parameters;
        for (const nlohmann::json& technique : nlohmann::json::parse(text)) {
            for (const nlohmann::json& parameter : technique["parameters"])
                for (std::set<std::string>& choices = parameters[parameter["name"]];
                     const nlohmann::json& choice : parameter["choices"])
                    choices.insert(choice);
            for (const nlohmann::json& preset : technique["presets"])
                parameters["preset"].insert(preset["name"]);
        }
        return parameters;
    }();
    return kParameters;
}

// The fault of "shadow=scattered|plain"; empty when there is none, or when it is not a setting.
std::string wrong_setting(const std::string& code) {
    static const std::regex setting("([a-z][a-z0-9_]*)=([a-z0-9_.|\\\\]*)");
    std::smatch match;
    if (!std::regex_match(code, match, setting)) return {};
    const auto parameter = all_parameters().find(match[1]);
    if (parameter == all_parameters().end()) return "no parameter " + match[1].str();
    std::string values = match[2];
    std::erase(values, '\\');
    for (const std::string_view value : split(values, '|'))
        if (!value.empty() && !parameter->second.empty() && !parameter->second.contains(std::string(value)))
            return match[1].str() + " cannot be " + std::string(value);
    return {};
}

// Every test as "folder.Suite.name", with the folder of tests/, techniques/ or subjects/ that has it.
const std::set<std::string>& all_tests() {
    static const std::set<std::string> kTests = [] {
        static const std::regex head("TEST(?:_F|_P)?\\((\\w+),\\s*(\\w+)\\)");
        std::set<std::string> tests;
        for (const std::string& file : source_files()) {
            const fs::path path = file;
            if (!path.stem().string().ends_with("_test")) continue;
            const std::string text = read(kRoot / file.substr(1)),
                              folder = path.parent_path().filename().string();
            for (std::sregex_iterator it(text.begin(), text.end(), head), end; it != end; ++it)
                tests.insert(folder + "." + (*it)[1].str() + "." + (*it)[2].str());
        }
        return tests;
    }();
    return kTests;
}

std::vector<std::string> tests_named_in(const std::string& text) {
    static const std::regex name("`([a-z0-9_]+\\.[A-Z]\\w*\\.\\w+)`");
    return matches(text, name, 1);
}

}  // namespace

TEST(Docs, every_file_and_heading_that_a_page_links_exists) {
    static const std::regex link("\\]\\(([^) ]+)\\)");
    size_t anchors = 0;
    for (const fs::path& page : pages())
        for (const std::string& target : matches(read(page), link, 1)) {
            EXPECT_THAT(wrong_link(page, target), IsEmpty()) << page << ": " << target;
            anchors += target.find('#') != std::string::npos;
        }
    EXPECT_GT(anchors, 0u);
}

TEST(Docs, every_picture_of_the_documentation_is_shown_by_a_page) {
    std::string all;
    for (const fs::path& page : pages()) all += read(page);
    size_t pictures = 0;
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / "docs")) {
        const std::string name = entry.path().filename().string();
        if (!name.ends_with(".jpg") && !name.ends_with(".png") && !name.ends_with(".svg")) continue;
        EXPECT_NE(all.find(name + ")"), std::string::npos) << entry.path() << " is in no page";
        ++pictures;
    }
    EXPECT_GT(pictures, 10u);
}

TEST(Docs, every_source_file_that_a_page_names_exists) {
    static const std::regex named(
        "^((?:dermis|techniques|subjects|catalog|shaders|apps|tests|tools|bench|scenes|docs|cmake)/[^ "
        ":,]*)$");
    static const std::regex source("[a-z0-9_/]+\\.(cpp|h|glsl|frag|vert|comp)");
    for (const fs::path& page : pages())
        for (const std::string& code : code_of(read(page))) {
            std::smatch match;
            if (std::regex_match(code, match, named)) EXPECT_TRUE(exists(match[1])) << page << ": " << code;
            if (std::regex_match(code, source)) EXPECT_TRUE(is_source(code)) << page << ": " << code;
        }
}

TEST(Docs, every_benchmark_that_a_page_names_exists) {
    static const std::regex named("build/bench/([a-z_]+)");
    size_t found = 0;
    for (const fs::path& page : pages())
        for (const std::string& name : matches(read(page), named, 1)) {
            EXPECT_TRUE(fs::exists(kRoot / "bench" / (name + ".cpp"))) << page << ": " << name;
            ++found;
        }
    EXPECT_GT(found, 3u);
}

TEST(Docs, every_setting_that_a_page_on_techniques_names_is_one_of_a_technique) {
    ASSERT_GT(all_parameters().size(), 20u);
    for (const fs::path& page : pages()) {
        if (page.string().find("/techniques/") == std::string::npos && page.filename() != "sources.md")
            continue;
        for (const std::string& code : code_of(read(page)))
            EXPECT_THAT(wrong_setting(code), IsEmpty()) << page << ": " << code;
    }
}

TEST(Docs, every_test_that_a_page_names_exists) {
    size_t found = 0;
    for (const fs::path& page : pages())
        for (const std::string& name : tests_named_in(read(page))) {
            EXPECT_TRUE(all_tests().contains(name)) << page << ": " << name;
            ++found;
        }
    EXPECT_GT(found, 60u);
}

// A part without a test says so by a dash, or refers to another table.
TEST(Docs, every_part_of_a_source_names_its_tests) {
    size_t rows = 0;
    std::istringstream lines(read(kRoot / "docs/sources.md"));
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("| ") || line.ends_with("tests |")) continue;
        const size_t bar = line.rfind(" | ");
        ASSERT_NE(bar, std::string::npos) << line;
        const std::string tests = line.substr(bar);
        EXPECT_TRUE(!tests_named_in(tests).empty() || tests == " | — |" || tests.ends_with("below |"))
            << line;
        ++rows;
    }
    EXPECT_GT(rows, 45u);
}

namespace {

// "dermis view", "tests/bake/rows_test.cpp", "build/bench/lut_bench", "tools/soak", "optics.Suite.name".
bool measures(const std::string& code) {
    static const std::regex place("(?:build/)?((?:tests|bench|tools)/[^ ]+).*"), call("dermis [a-z].*");
    std::smatch match;
    if (std::regex_match(code, match, place)) return exists(match[1]);
    return std::regex_match(code, call) || all_tests().contains(code);
}

bool names_a_measure(const std::string& text) {
    return std::ranges::any_of(matches(text, std::regex("`([^`]+)`"), 1), measures);
}

// Rows of tables without a measure, neither in the last cell nor in the section's "Measured by ...".
std::vector<std::string> figures_without_measure(const std::string& page) {
    std::vector<std::string> found;
    bool of_section = false, in_table = false;
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("## ")) of_section = false;
        if (line.starts_with("Measured by ")) of_section = names_a_measure(line);
        const bool row = line.starts_with("| ");
        if (row && in_table && !of_section &&
            !names_a_measure(line.substr(line.rfind("| ", line.size() - 3))))
            found.push_back(line);
        in_table = row || line.starts_with("|-");
    }
    return found;
}

}  // namespace

TEST(Docs, every_figure_names_what_measures_it) {
    EXPECT_THAT(figures_without_measure(read(kRoot / "docs/figures.md")), IsEmpty());
    const std::string table = "| what | figure | measured by |\n|---|---|---|\n";
    EXPECT_THAT(figures_without_measure(table + "| time | 1 s | `build/bench/lut_bench` |\n"), IsEmpty());
    EXPECT_EQ(figures_without_measure(table + "| time | 1 s | by hand |\n").size(), 1u);
    EXPECT_EQ(figures_without_measure(table + "| time | 1 s | `bench/none` |\n").size(), 1u);
    EXPECT_THAT(figures_without_measure("Measured by `tools/soak`.\n\n| a | b |\n|---|---|\n| c | d |\n"),
                IsEmpty());
}

TEST(Docs, unknown_files_headings_and_settings_are_found) {
    EXPECT_FALSE(exists("dermis/render/no_such_file"));
    EXPECT_TRUE(exists("dermis/render/renderer"));
    EXPECT_FALSE(is_source("no_such_test.cpp"));
    EXPECT_TRUE(is_source("docs_names_test.cpp"));
    EXPECT_EQ(tests_named_in("see `cli.Docs.no_such` and `docs_names_test.cpp`"),
              std::vector<std::string>{"cli.Docs.no_such"});
    EXPECT_FALSE(all_tests().contains("cli.Docs.no_such"));
    const fs::path page = kRoot / "docs/terminology.md";
    EXPECT_EQ(wrong_link(page, "profiles.md#no-such-heading"), "no heading #no-such-heading");
    EXPECT_EQ(wrong_link(page, "profiles.md#sums-of-gaussians"), "");
    EXPECT_EQ(wrong_link(page, "#light"), "");
    EXPECT_NE(wrong_link(page, "images/no_such.jpg"), "");
    EXPECT_EQ(wrong_setting("shadow=scatered"), "shadow cannot be scatered");
    EXPECT_EQ(wrong_setting("no_such=plain"), "no parameter no_such");
    EXPECT_EQ(wrong_setting("shadow=scattered\\|plain"), "");
}
