// Every option of every command, as --help lists them: what is not a number, and text without end, is refused
// by one line, before anything is computed.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cli/help_pages.h"
#include "support/temporary_directory.h"

using namespace dermis;

namespace {

class FlagLimits : public testing::Test {
  protected:
    ProgramResult dermis(const std::string& arguments) {
        // The bust is made at its first use: a quarter of a minute.
        return run_shell("timeout 120 " DERMIS_PROGRAM " " + arguments, directory_.path.string());
    }
    void for_each_command(const auto& check) { dermis::for_each_command(directory_.path.string(), check); }
    void expect_refused(const std::string& line) {
        const ProgramResult result = dermis(line);
        EXPECT_EQ(result.exit_code, 2) << line;
        EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << line << ": " << result.err;
        EXPECT_EQ(result.out, "") << line;
    }

    TemporaryDirectory directory_;
};

}  // namespace

TEST_F(FlagLimits, what_is_no_number_is_refused_for_every_option_that_takes_one) {
    int numbers = 0;
    for_each_command([&](const std::string& command, const HelpPage& page) {
        for (const HelpOption& option : page.options) {
            if (option.type == "TEXT" || option.type == "OUTPUT") continue;
            constexpr std::array kValues = {"nan", "-inf", "''", "1e999", "x"};
            for (const int shift : {0, 2})  // two of them for each option, each of them for many
                expect_refused(command + " " + option.name + " " + kValues[(numbers + shift) % 5]);
            ++numbers;
        }
    });
    EXPECT_GT(numbers, 20) << "--help is not what it was";
}

TEST_F(FlagLimits, a_number_beyond_its_range_is_refused_for_every_option) {
    for_each_command([&](const std::string& command, const HelpPage& page) {
        for (const HelpOption& option : page.options) {
            if (option.type == "TEXT" || option.type == "OUTPUT") continue;
            ASSERT_TRUE(option.range) << command << " " << option.name << " states no range";
            const auto& [min, max] = *option.range;
            ASSERT_LT(min, max) << command << " " << option.name;
            for (const double value : {min - std::max(1.0, std::abs(min)), max + std::max(1.0, max)})
                expect_refused(command + " " + option.name + "=" + std::to_string(value));
            const double inside = std::min(std::ceil(min), max);
            const std::string text =
                option.type == "FLOAT" ? std::to_string(inside) : std::to_string(long(inside));
            const ProgramResult taken =
                dermis(command + " " + option.name + "=" + text + " --no-such-option");
            EXPECT_EQ(taken.err.find("range"), std::string::npos) << taken.err;
        }
    });
}

TEST_F(FlagLimits, text_of_100000_characters_ends_in_one_short_line) {
    size_t numbers = 0;
    for_each_command([&](const std::string& command, const HelpPage& page) {
        for (const HelpOption& option : page.options) {
            const bool is_text = option.type == "TEXT" || option.type == "OUTPUT";
            if (!is_text && ++numbers % 5) continue;
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
