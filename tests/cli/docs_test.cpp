// The documentation names commands and flags: each of them exists.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include "cli/docs_pages.h"
#include "cli/run_program.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

using namespace dermis;
using namespace dermis::docs;
using testing::Contains;
using testing::IsEmpty;

namespace {

using Flags = std::set<std::string>;
/// By command: "render", "bake lut"; "" has the flags of the program itself.
using KnownCommands = std::map<std::string, Flags>;

Flags flags_in(const std::string& text) {
    static const std::regex flag("--[a-z][a-z0-9-]*");
    const std::vector<std::string> found = matches(text, flag);
    return {found.begin(), found.end()};
}

// Reads --help of the program, its commands and theirs.
void add_command(const std::string& name, const std::string& scratch, KnownCommands& commands) {
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

const KnownCommands& all_commands() {
    static const KnownCommands kCommands = [] {
        TemporaryDirectory scratch;
        KnownCommands commands;
        add_command("", scratch.path.string(), commands);
        return commands;
    }();
    return kCommands;
}

// The fault of the calls of dermis in one line of code; empty when there is none.
std::string wrong_call(const std::string& code, const KnownCommands& commands) {
    static const std::regex call("(?:^|[ |;(])(?:dermis|\\./run)((?: +[a-z][a-z0-9_-]*)*)(?= |$)");
    std::smatch match;
    if (!std::regex_search(code, match, call)) return {};
    const std::vector<std::string> words = matches(match[1].str(), std::regex("[a-z][a-z0-9_-]*"));
    if (words.empty()) return {};
    std::string command = words[0];
    if (command == "python") return {};  // of ./run: an interpreter
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
        "^ *(sudo |\\$ |[A-Z_]+=\\S* "
        ")*(\\S*/)?(pip|python3|cmake|ctest|apt-get|git|clang\\S*|npm|cpack|sbatch)\\b");
    return std::regex_search(code, other);
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

TEST(Docs, an_unknown_command_and_flag_are_found) {
    const KnownCommands& commands = all_commands();
    ASSERT_TRUE(commands.contains("bake lut"));
    EXPECT_EQ(wrong_call("dermis profiles", commands), "no command 'profiles'");
    EXPECT_EQ(wrong_call("./run bake lot -o x.exr", commands), "no command 'bake lot'");
    EXPECT_EQ(wrong_call("dermis render bust --sise 64x64", commands), "render has no --sise");
    EXPECT_EQ(wrong_call("dermis render bust --size 64x64", commands), "");
    EXPECT_THAT(every_known_flag(), testing::Not(Contains("--sise")));
}
