#include "command.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <type_traits>
#include <utility>

#include "dermis/base/text.h"

namespace dermis::cli {

void print_message(std::string_view text) {
    constexpr size_t kMaxBytes = 4000;  // lists of known names are long
    std::fprintf(stderr, "dermis: %s\n", printable_line(text, kMaxBytes).c_str());
}

void print_warning(std::string_view text) {
    print_message("warning: " + std::string(text));
}

void print_warnings(std::span<const std::string> texts, const std::string& prefix) {
    for (const std::string& text : each_once(texts)) print_warning(prefix + text);
}

void print_path(const std::filesystem::path& path) {
    std::printf("%s\n", printable_line(path.string()).c_str());
}

Result<IndexRange> parse_index_range(std::string_view flag, std::string_view text) {
    constexpr double kMost = 1e6;
    const std::vector<std::string_view> ends = split(text, ':');
    std::vector<int> numbers;
    for (const std::string_view end : ends)
        if (const std::optional<double> number = parse_number(trim(end));
            number && *number >= 0 && *number <= kMost && *number == std::floor(*number))
            numbers.push_back(int(*number));
    if (ends.size() == 2 && numbers.size() == 2) return IndexRange{numbers[0], numbers[1]};
    return Error{std::string(flag) + " '" + std::string(text) + "': write BEGIN:END, such as 0:16"};
}

Result<Size> parse_size(std::string_view text) {
    const std::vector<std::string_view> sides = split(text, 'x');
    const auto side = [](std::string_view part) -> int {
        const std::optional<double> value = parse_number(part);
        return value && *value >= 1 && *value <= 8192 && *value == int(*value) ? int(*value) : 0;
    };
    const Size size = {side(sides.front()), side(sides.back())};
    if (sides.size() <= 2 && size.width != 0 && size.height != 0) return size;
    return Error{"--size '" + std::string(text) +
                 "': write WIDTHxHEIGHT or one side, each 1 to 8192, such as 1024x768"};
}

Option* Option::required() {
    option_->required();
    return this;
}

Option* Option::capture_default_str() {
    option_->capture_default_str();
    return this;
}

Option* Option::allow_extra_args(bool allowed) {
    option_->allow_extra_args(allowed);
    return this;
}

namespace {

// CLI11 takes "nan" and "inf" for numbers, nothing at all for 0, and what no double holds for infinity. Empty
// when the text is fine.
std::string finite_number(const std::string& text) {
    const std::optional<double> number = parse_number(text);
    if (!number) return text.empty() ? "a number is missing" : text + " is not a number";
    return std::abs(*number) <= std::numeric_limits<float>::max() ? "" : text + " is not a finite number";
}

// 100000, where to_text() writes 1e+05.
std::string range_number(double number) {
    return number == std::floor(number) && std::abs(number) < 1e10 ? std::to_string(int64_t(number))
                                                                   : to_text(number);
}

bool is_within(double number, NumberRange range) {
    return number >= range.min && number <= range.max;
}

std::string not_within(NumberRange range) {
    return " is not in its range, " + range_number(range.min) + " to " + range_number(range.max);
}

// The result of a function that returns or fails, once the files are found good.
template <class Function>
auto after_check(const FileLister& files, const Function& function) {
    return [files, function](const auto&... arguments) -> decltype(function(arguments...)) {
        DERMIS_TRY_ASSIGN(const FileUse listed, files());
        DERMIS_TRY(check_outputs(listed));
        return function(arguments...);
    };
}

}  // namespace

Result<void> check_number(const std::string& flag, double value, NumberRange range) {
    if (is_within(value, range)) return {};
    return Error{flag + ": " + to_text(value) + not_within(range)};
}

template <class Value>
Option* Command::add_any(const std::string& names, Value& value, const std::string& help) {
    return &options_.emplace_back(app_->add_option(names, value, help));
}

template <class Value>
Option* Command::add_number(const std::string& names, Value& value, NumberRange range,
                            const std::string& help) {
    Option* option = add_any(names, value, help);
    const auto wrong = [range](const std::string& text) -> std::string {
        if (std::string reason = finite_number(text); !reason.empty()) return reason;
        return is_within(*parse_number(text), range) ? "" : text + not_within(range);
    };
    option->option_->check(CLI::Validator(wrong, range_number(range.min) + ".." + range_number(range.max)));
    return option;
}

Option* Command::add_output(const std::string& names, std::string& path, const std::string& help) {
    Option* option = add_any(names, path, help);
    option->option_->type_name("OUTPUT");
    return option;
}

Option* Command::add_option(const std::string& names, std::string& value, const std::string& help) {
    return add_any(names, value, help);
}

Option* Command::add_option(const std::string& names, std::optional<std::string>& value,
                            const std::string& help) {
    return add_any(names, value, help);
}

Option* Command::add_option(const std::string& names, std::vector<std::string>& value,
                            const std::string& help) {
    return add_any(names, value, help);
}

Option* Command::add_option(const std::string& names, std::optional<double>& value, NumberRange range,
                            const std::string& help) {
    return add_number(names, value, range, help);
}

Option* Command::add_option(const std::string& names, double& value, NumberRange range,
                            const std::string& help) {
    return add_number(names, value, range, help);
}

Option* Command::add_option(const std::string& names, float& value, NumberRange range,
                            const std::string& help) {
    return add_number(names, value, range, help);
}

Option* Command::add_option(const std::string& names, int& value, NumberRange range,
                            const std::string& help) {
    return add_number(names, value, range, help);
}

Option* Command::add_option(const std::string& names, uint32_t& value, NumberRange range,
                            const std::string& help) {
    return add_number(names, value, range, help);
}

Option* Command::add_flag(const std::string& names, bool& value, const std::string& help) {
    return &options_.emplace_back(app_->add_flag(names, value, help));
}

void Command::require_subcommand() {
    app_->require_subcommand(1);
}

void Command::allow_extras() {
    app_->allow_extras();
}

namespace {

constexpr size_t kHelpColumns = 80, kOptionIndent = 30, kExampleIndent = 4;

// Lines of at most kHelpColumns. The text of an option continues below its beginning, other text at the left.
std::string wrapped_help(const std::string& text) {
    std::string wrapped;
    size_t deep = kOptionIndent;
    for (std::string_view line : split(text, '\n')) {
        if (line.starts_with("Example:")) deep = kExampleIndent;
        const std::string indent(line.starts_with("  ") ? deep : 0, ' ');
        std::string rest(line);
        while (rest.size() > kHelpColumns) {
            const size_t space = rest.rfind(' ', kHelpColumns);
            if (space == std::string::npos || space <= indent.size()) break;  // a word is never broken
            wrapped += rest.substr(0, space) + "\n";
            rest = indent + rest.substr(space + 1);
        }
        wrapped += rest + "\n";
    }
    wrapped.pop_back();
    return wrapped;
}

struct HelpFormatter : CLI::Formatter {
    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
        return wrapped_help(CLI::Formatter::make_help(app, std::move(name), mode));
    }
};

}  // namespace

CommandLine::CommandLine(const std::string& version, const std::string& summary, const std::string& example)
    : app_(std::make_unique<CLI::App>(summary, "dermis")) {
    app_->set_version_flag("--version", version);
    app_->require_subcommand(1);
    app_->formatter(std::make_shared<HelpFormatter>());
    app_->footer("Example:\n  " + example);
}

CommandLine::~CommandLine() = default;

Command* CommandLine::add(const std::string& name, const std::string& summary, const std::string& example,
                          Command* parent) {
    CLI::App* command = (parent ? parent->app_ : app_.get())->add_subcommand(name, summary);
    command->footer("Example:\n  " + example);
    return &commands_.emplace_back(command);
}

Command* CommandLine::find(const std::string& name) {
    for (Command& command : commands_)
        if (command.app_->get_parent() == app_.get() && command.app_->get_name() == name) return &command;
    return nullptr;
}

void CommandLine::when_chosen(Command* command, FileLister lister, Action run, Planner planner) {
    command->app_->callback([this, lister, run = Action(after_check(lister, run)),
                             planner = planner ? Planner(after_check(lister, planner)) : Planner()] {
        files = lister;
        action = run;
        plan = planner;
    });
}

namespace {

// The command of the line, "dermis bake lut": the words that name nested commands.
const CLI::App* chosen_command(const CLI::App* app, const std::vector<std::string>& words) {
    for (const std::string& word : words) {
        const auto commands = app->get_subcommands([](const CLI::App*) { return true; });
        const auto found = std::ranges::find_if(
            commands, [&](const CLI::App* command) { return command->get_name() == word; });
        if (found == commands.end()) break;
        app = *found;
    }
    return app;
}

std::string full_name(const CLI::App* app) {
    const CLI::App* parent = app->get_parent();
    return parent ? full_name(parent) + " " + app->get_name() : app->get_name();
}

std::vector<std::string> flags_of(const CLI::App* app) {
    std::vector<std::string> flags;
    for (const CLI::Option* option : app->get_options()) {
        for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
        for (const std::string& name : option->get_snames()) flags.push_back("-" + name);
    }
    return flags;
}

// "unknown option '--tecnique'; did you mean '--technique'?", of the first one typed; empty where all are
// known.
std::string unknown_option(const CLI::App* app, const std::vector<std::string>& words) {
    const std::vector<std::string> flags = flags_of(app);
    for (const std::string& word : words) {
        if (word == "--") break;
        const std::string flag = word.substr(0, word.find('='));
        if (!flag.starts_with("--") || std::ranges::find(flags, flag) != flags.end()) continue;
        const auto closest = closest_name(flag, flags);
        return "unknown option '" + flag + "'" + (closest ? "; did you mean '" + *closest + "'?" : "");
    }
    return {};
}

}  // namespace

Result<void> CommandLine::parse_or_throw_help(std::vector<std::string> line) {
    words = std::move(line);
    // CLI11 would say only that a subcommand is missing.
    if (!words.empty() && !words[0].starts_with('-') && !find(words[0])) {
        std::vector<std::string> names;
        for (const CLI::App* command : app_->get_subcommands({})) names.push_back(command->get_name());
        return Error{unknown_name("command", words[0], names)};
    }
    try {
        app_->parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 takes the last first
    } catch (const CLI::Success&) {                                           // --help, --version
        throw;
    } catch (const CLI::ExtrasError& wrong) {
        const CLI::App* command = chosen_command(app_.get(), words);
        const std::string option = unknown_option(command, words);
        return Error{(option.empty() ? std::string(wrong.what()) : option) + " (see " + full_name(command) +
                     " --help)"};
    } catch (const CLI::ParseError& wrong) {
        return Error{std::string(wrong.what()) + " (see " + full_name(chosen_command(app_.get(), words)) +
                     " --help)"};
    }
    return {};
}

std::optional<int> CommandLine::parse(int argc, char** argv) {
    try {
        const Result<void> parsed = parse_or_throw_help({argv + std::min(argc, 1), argv + argc});
        if (parsed) return std::nullopt;
        print_message(parsed.error().message);
        return 2;
    } catch (const CLI::Success& done) {
        return app_->exit(done);
    }
}

Result<void> CommandLine::parse_words(std::vector<std::string> line) {
    try {
        return parse_or_throw_help(std::move(line));
    } catch (const CLI::Success&) {
        return Error{"asks for help and does nothing"};
    }
}

}  // namespace dermis::cli
