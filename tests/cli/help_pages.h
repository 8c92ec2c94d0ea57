#pragma once
// Every command of the program with its options, as --help lists them: a new command is among them.

#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "cli/run_program.h"

namespace dermis {

struct HelpOption {
    std::string name, type;  ///< "--frames", "INT"; what a command writes is an OUTPUT
    struct Range {
        double min = 0, max = 0;
    };
    std::optional<Range> range;  ///< of a number
};

struct HelpPage {
    std::vector<HelpOption> options;
    std::vector<std::string> commands, positionals;
};

/// CLI11 writes "  -o,--output OUTPUT [out/a.png] ...", "  --frames INT:1..100000 ...", and the commands
/// under "Subcommands:".
inline HelpPage parse_help(const std::string& text) {
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
        HelpOption option{.name = names.substr(0, names.find(',')), .type = type.substr(0, type.find(':'))};
        if (const size_t dots = type.find(".."); dots != std::string::npos)
            option.range = {std::stod(type.substr(type.find(':') + 1)), std::stod(type.substr(dots + 2))};
        for (const char* known : {"TEXT", "INT", "UINT", "FLOAT", "OUTPUT"})
            if (option.type == known) page.options.push_back(option);
    }
    return page;
}

/// `check` gets the name ("bake lut") and the page of every command that has none of its own.
inline void for_each_command(const std::string& scratch, const auto& check, const std::string& command = "") {
    const HelpPage page = parse_help(run_shell(DERMIS_PROGRAM " " + command + " --help", scratch).out);
    if (page.commands.empty()) return check(command, page);
    for (const std::string& name : page.commands)
        for_each_command(scratch, check, command.empty() ? name : command + " " + name);
}

}  // namespace dermis
