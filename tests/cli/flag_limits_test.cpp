// Every option of every command, as --help lists them: what is no number, and text without end, is refused
// by one line, before anything is computed.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "cli/run_program.h"
#include "support/temporary_directory.h"

using namespace dermis;

namespace {

struct HelpOption {
    std::string name, type;  // "--frames", "INT"
};
struct HelpPage {
    std::vector<HelpOption> options;
    std::vector<std::string> commands, positionals;
};

// CLI11 writes "  -o,--output TEXT [out/a.png] ...", and the commands under "Subcommands:".
HelpPage parse_help(const std::string& text) {
    HelpPage page;
    std::istringstream lines(text);
    std::string heading;
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("  ")) heading = line;
        std::istringstream words(line);
        std::string names, type;
        words >> names >> type;
        if (!line.starts_with("  ") || line.starts_with("   ") || names.empty()) continue;
        if (heading == "Subcommands:") page.commands.push_back(names);
        if (heading == "Positionals:") page.positionals.push_back(names);
        if (heading != "Options:" || !names.starts_with("-")) continue;
        type = type.substr(0, type.find('='));
        if (type == "TEXT" || type == "INT" || type == "UINT" || type == "FLOAT")
            page.options.push_back({names.substr(0, names.find(',')), type});
    }
    return page;
}

class FlagLimits : public testing::Test {
  protected:
    ProgramResult dermis(const std::string& arguments) {
        return run_shell("timeout 20 " DERMIS_PROGRAM " " + arguments, directory_.path.string());
    }
    HelpPage help(const std::string& command) { return parse_help(dermis(command + " --help").out); }

    /// Of the commands that have none of their own.
    void for_each_command(const std::string& command, const auto& check) {
        const HelpPage page = help(command);
        if (page.commands.empty()) return check(command, page);
        for (const std::string& name : page.commands)
            for_each_command(command.empty() ? name : command + " " + name, check);
    }

    TemporaryDirectory directory_;
};

}  // namespace

TEST_F(FlagLimits, what_is_no_number_is_refused_for_every_option_that_takes_one) {
    int numbers = 0;
    for_each_command("", [&](const std::string& command, const HelpPage& page) {
        for (const HelpOption& option : page.options) {
            if (option.type == "TEXT") continue;
            ++numbers;
            for (const char* value : {"nan", "-inf", "''", "1e999", "x"}) {
                const std::string line = command + " " + option.name + " " + value;
                const ProgramResult result = dermis(line);
                EXPECT_EQ(result.exit_code, 2) << line;
                EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << line << ": " << result.err;
                EXPECT_EQ(result.out, "") << line;
            }
        }
    });
    EXPECT_GT(numbers, 20) << "--help is not what it was";
}

TEST_F(FlagLimits, text_of_100000_characters_ends_in_one_short_line) {
    for_each_command("", [&](const std::string& command, const HelpPage& page) {
        for (const HelpOption& option : page.options) {
            // What a command cannot do without is absent, so that no text makes it start.
            const bool starts = page.positionals.empty();
            const std::string line = command + " " + option.name +
                                     " $(head -c 100000 /dev/zero | tr '\\0' 9)" +
                                     (starts ? " --no-such-option" : "");
            const ProgramResult result = dermis(line);
            EXPECT_TRUE(result.exit_code == 1 || result.exit_code == 2)
                << command << " " << option.name << ": exit " << result.exit_code;
            EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << command << " " << option.name;
            EXPECT_LT(result.err.size(), 5000u) << command << " " << option.name;
        }
    });
}
