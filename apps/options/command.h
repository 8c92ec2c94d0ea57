#pragma once
// The command line: commands with their options, and the action that the chosen one leaves behind. CLI11
// parses it, in command.cpp alone: its header costs more to compile than any command does.

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/output_check.h"
#include "dermis/base/result.h"
#include "dermis/jobs/job_list.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace dermis::cli {

/// Both ends belong to it.
struct NumberRange {
    double min = 0, max = 0;
};
/// "--frames: 0 is not in its range, 1 to 100000".
[[nodiscard]] Result<void> check_number(const std::string& flag, double value, NumberRange range);

inline constexpr NumberRange kUnitRangeMm = {1e-6, 1e6};

/// An option or an argument of a command.
class Option {
  public:
    explicit Option(CLI::Option* option) : option_(option) {}
    Option* required();
    /// --help shows the value that the variable has now.
    Option* capture_default_str();
    /// false: `--set a=1 b` takes one value, and b is an argument of its own.
    Option* allow_extra_args(bool allowed);

  private:
    friend class Command;
    CLI::Option* option_;
};

/// A command and its options. `value` must live until the action has run; it keeps its value when the option
/// is absent.
class Command {
  public:
    explicit Command(CLI::App* app) : app_(app) {}
    Option* add_option(const std::string& names, std::string& value, const std::string& help);
    Option* add_option(const std::string& names, std::optional<std::string>& value, const std::string& help);
    Option* add_option(const std::string& names, std::vector<std::string>& value, const std::string& help);
    /// A number outside of `range` is refused; --help shows the range.
    Option* add_option(const std::string& names, std::optional<double>& value, NumberRange range,
                       const std::string& help);
    Option* add_option(const std::string& names, double& value, NumberRange range, const std::string& help);
    Option* add_option(const std::string& names, float& value, NumberRange range, const std::string& help);
    Option* add_option(const std::string& names, int& value, NumberRange range, const std::string& help);
    Option* add_option(const std::string& names, uint32_t& value, NumberRange range, const std::string& help);
    /// A file or folder to write; --help calls its type OUTPUT. The command's FileLister has what it makes.
    Option* add_output(const std::string& names, std::string& path, const std::string& help);
    Option* add_flag(const std::string& names, bool& value, const std::string& help);
    /// This command is nothing without one of its own.
    void require_subcommand();
    /// Accepts whatever follows.
    void allow_extras();

  private:
    friend class CommandLine;
    template <class Value>
    Option* add_any(const std::string& names, Value& value, const std::string& help);
    template <class Value>
    Option* add_number(const std::string& names, Value& value, NumberRange range, const std::string& help);

    CLI::App* app_;
    std::deque<Option> options_;  // a deque: pointers to its elements stay valid
};

/// How a command is split into jobs: into so many parts at most, with files in this folder.
using Planner = std::function<Result<JobPlan>(int parts, const std::string& folder)>;

/// Runs after parsing; the value is the exit code, an error is printed as one line and exits with 1.
using Action = std::function<Result<int>()>;

/// The files that a command writes, and those that its options name as inputs. Errors: an output of a kind
/// that the command does not write.
using FileLister = std::function<Result<FileUse>()>;
[[nodiscard]] inline Result<FileUse> writes_nothing() {
    return FileUse{};
}

class CommandLine {
  public:
    /// What `dermis --version` prints, and what --help says of the program.
    CommandLine(const std::string& version, const std::string& summary, const std::string& example);
    ~CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    /// A subcommand of `parent` (of the program by default); every one has an example under its --help.
    Command* add(const std::string& name, const std::string& summary, const std::string& example,
                 Command* parent = nullptr);
    /// `dermis NAME` if it was added already, otherwise null.
    Command* find(const std::string& name);
    /// The files of `lister` are checked by check_outputs() before `run` or `plan` does anything. `plan` is
    /// for the commands that dermis jobs takes.
    void when_chosen(Command* command, FileLister lister, Action run, Planner plan = {});

    /// The exit code, or nothing when a command was chosen: then call `action`. Prints help and what was
    /// wrong.
    [[nodiscard]] std::optional<int> parse(int argc, char** argv);
    /// A line of a file, without the program's name; prints nothing.
    [[nodiscard]] Result<void> parse_words(std::vector<std::string> line);
    FileLister files;
    Action action;
    Planner plan;
    /// What was parsed, without the program's name.
    std::vector<std::string> words;

  private:
    Result<void> parse_or_throw_help(std::vector<std::string> line);

    std::unique_ptr<CLI::App> app_;
    std::deque<Command> commands_;
};

/// Of a picture or a table.
struct Size {
    int width = 0, height = 0;
};
/// "1024x768", or "512" for a square; each side 1 to 8192. The error names --size.
[[nodiscard]] Result<Size> parse_size(std::string_view text);

/// One line on the error stream, whatever file names and values it quotes (printable_line).
void print_message(std::string_view text);
void print_warning(std::string_view text);
/// Each once, with the number of times that it came.
void print_warnings(std::span<const std::string> texts, const std::string& prefix = "");
/// On standard output, a line: names of files can have anything in them.
void print_path(const std::filesystem::path& path);

/// begin <= i < end.
struct IndexRange {
    int begin = 0, end = 0;
};
/// "4:12", whole numbers from 0 to 10^6. The error names the flag.
[[nodiscard]] Result<IndexRange> parse_index_range(std::string_view flag, std::string_view text);

/// Generated: calls add_NAME_command of every commands/NAME.cpp.
void add_all_commands(CommandLine& line);

}  // namespace dermis::cli
