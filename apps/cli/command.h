#pragma once
// What a command of the command line is: a CLI11 subcommand that leaves an action behind when it was chosen.

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "dermis/base/result.h"

namespace dermis::cli {

/// Runs after parsing; the value is the exit code, an error is printed as one line and exits with 1.
using Action = std::function<Result<int>()>;

struct CommandLine {
    CLI::App& app;
    Action action;

    /// A subcommand of `parent` (the app itself by default); every one has an example under its --help.
    CLI::App* add(const std::string& name, const std::string& summary, const std::string& example,
                  CLI::App* parent = nullptr) {
        CLI::App* command = (parent ? parent : &app)->add_subcommand(name, summary);
        command->footer("Example:\n  " + example);
        return command;
    }

    void when_chosen(CLI::App* command, Action run) {
        command->callback([this, run = std::move(run)] { action = run; });
    }
};

/// Generated: calls add_NAME_command of every commands/NAME.cpp.
void add_all_commands(CommandLine& line);

}  // namespace dermis::cli
