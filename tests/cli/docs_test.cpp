// The documentation names commands, flags and files: each of them exists.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include "cli/run_program.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

namespace fs = std::filesystem;
using namespace dermis;
using testing::Contains;
using testing::IsEmpty;

namespace {

const fs::path kRoot = DERMIS_SOURCE_DIR;

using Flags = std::set<std::string>;
/// By command: "render", "bake lut"; "" has the flags of the program itself.
using Commands = std::map<std::string, Flags>;

std::vector<std::string> matches(const std::string& text, const std::regex& pattern, size_t group = 0) {
    std::vector<std::string> found;
    for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
        found.push_back((*it)[group]);
    return found;
}

Flags flags_in(const std::string& text) {
    static const std::regex flag("--[a-z][a-z0-9-]*");
    const std::vector<std::string> found = matches(text, flag);
    return {found.begin(), found.end()};
}

// Reads --help of the program, its commands and theirs.
void add_command(const std::string& name, const std::string& scratch, Commands& commands) {
    const std::string help = run_shell(std::string(DERMIS_PROGRAM) + " " + name + " --help", scratch).out;
    Flags flags;
    std::istringstream lines(help);
    bool lists_commands = false;
    for (std::string line; std::getline(lines, line);) {
        static const std::regex row("^  (-[a-zA-Z],)?(--[a-z0-9-]+).*"), word("^  ([a-z][a-z0-9_-]*)  .*");
        if (line.starts_with("Subcommands:")) lists_commands = true;
        if (line.starts_with("Example")) lists_commands = false;
        std::smatch match;
        if (std::regex_match(line, match, row)) flags.insert(match[2]);
        if (lists_commands && std::regex_match(line, match, word))
            add_command(name.empty() ? match[1].str() : name + " " + match[1].str(), scratch, commands);
    }
    commands[name] = flags;
}

const Commands& all_commands() {
    static const Commands kCommands = [] {
        TemporaryDirectory scratch;
        Commands commands;
        add_command("", scratch.path.string(), commands);
        return commands;
    }();
    return kCommands;
}

std::string read(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<fs::path> pages() {
    std::vector<fs::path> found;
    for (const char* tree : {"docs", "techniques", "subjects", "tests", "scenes"})
        if (fs::exists(kRoot / tree))
            for (const auto& entry : fs::recursive_directory_iterator(kRoot / tree))
                if (entry.path().extension() == ".md") found.push_back(entry.path());
    for (const auto& entry : fs::directory_iterator(kRoot))
        if (entry.path().extension() == ".md") found.push_back(entry.path());
    return found;
}

// Indented blocks and fenced blocks line by line (continued lines joined), then spans between backticks.
std::vector<std::string> code_of(const std::string& page) {
    std::vector<std::string> code;
    std::string prose, joined;
    bool fenced = false;
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("```")) {
            fenced = !fenced;
        } else if (fenced || line.starts_with("    ")) {
            line = line.substr(0, line.find(" #"));
            joined += line;
            if (joined.ends_with('\\')) {
                joined.pop_back();
                continue;
            }
            code.push_back(std::exchange(joined, {}));
        } else {
            prose += line + " ";
        }
    }
    static const std::regex span("`([^`]+)`");
    for (const std::string& text : matches(prose, span, 1)) code.push_back(text);
    return code;
}

// What is wrong with the calls of dermis in one line of code; empty when nothing is.
std::string wrong_call(const std::string& code, const Commands& commands) {
    static const std::regex call("(?:^|[ |;(])(?:dermis|\\./run)((?: +[a-z][a-z0-9_-]*)*)(?= |$)");
    std::smatch match;
    if (!std::regex_search(code, match, call)) return {};
    const std::vector<std::string> words = matches(match[1].str(), std::regex("[a-z][a-z0-9_-]*"));
    if (words.empty()) return {};
    std::string command = words[0];
    if (!commands.contains(command)) return "no command '" + command + "'";
    const bool has_inner =
        std::ranges::any_of(commands, [&](const auto& c) { return c.first.starts_with(command + " "); });
    if (has_inner && words.size() > 1) {
        command += " " + words[1];
        if (!commands.contains(command)) return "no command '" + command + "'";
    }
    const std::string arguments = code.substr(size_t(match.position()));
    for (const std::string& flag : flags_in(arguments))
        if (!commands.at(command).contains(flag)) return command + " has no " + flag;
    return {};
}

Flags every_known_flag() {
    Flags all;
    for (const auto& [name, flags] : all_commands()) all.insert(flags.begin(), flags.end());
    for (const auto& entry : fs::directory_iterator(kRoot / "tools"))
        if (entry.is_regular_file()) all.merge(flags_in(read(entry.path())));
    return all;
}

bool runs_another_program(const std::string& code) {
    static const std::regex other(
        "^ *(sudo |\\$ |[A-Z_]+=\\S* )*(cmake|ctest|apt-get|git|clang\\S*|npm|cpack|sbatch)\\b");
    return std::regex_search(code, other);
}

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

}  // namespace

TEST(Docs, every_command_that_a_page_calls_exists_and_takes_its_flags) {
    size_t calls = 0;
    for (const fs::path& page : pages())
        for (const std::string& code : code_of(read(page))) {
            EXPECT_THAT(wrong_call(code, all_commands()), IsEmpty()) << page << ": " << code;
            calls += code.find("dermis ") != std::string::npos;
        }
    EXPECT_GT(calls, 20u);
}

TEST(Docs, every_flag_on_its_own_is_one_of_a_command_or_a_tool) {
    const Flags known = every_known_flag();
    for (const fs::path& page : pages())
        for (const std::string& code : code_of(read(page)))
            if (!runs_another_program(code))
                for (const std::string& flag : flags_in(code))
                    EXPECT_THAT(known, Contains(flag)) << page << ": " << code;
}

TEST(Docs, every_file_that_a_page_names_exists) {
    static const std::regex named(
        "^((?:dermis|techniques|subjects|catalog|shaders|apps|tests|tools|bench|scenes|docs|cmake)/[^ "
        ":,]*)$");
    static const std::regex link("\\]\\(([^)#]+)(?:#[^)]*)?\\)");
    for (const fs::path& page : pages()) {
        const std::string text = read(page);
        for (const std::string& code : code_of(text)) {
            std::smatch match;
            if (std::regex_match(code, match, named)) EXPECT_TRUE(exists(match[1])) << page << ": " << code;
        }
        for (const std::string& target : matches(text, link, 1))
            if (target.find("://") == std::string::npos)
                EXPECT_TRUE(fs::exists(page.parent_path() / target)) << page << ": " << target;
    }
}

TEST(Docs, an_unknown_command_flag_and_file_are_found) {
    const Commands& commands = all_commands();
    ASSERT_TRUE(commands.contains("bake lut"));
    EXPECT_EQ(wrong_call("dermis profiles", commands), "no command 'profiles'");
    EXPECT_EQ(wrong_call("./run bake lot -o x.exr", commands), "no command 'bake lot'");
    EXPECT_EQ(wrong_call("dermis render bust --sise 64x64", commands), "render has no --sise");
    EXPECT_EQ(wrong_call("dermis render bust --size 64x64", commands), "");
    EXPECT_FALSE(exists("dermis/render/no_such_file"));
    EXPECT_TRUE(exists("dermis/render/renderer"));
    EXPECT_THAT(every_known_flag(), testing::Not(Contains("--sise")));
}
