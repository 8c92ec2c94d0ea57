// dermis: parses, calls, prints. What a command does is in dermis/.

#include "command.h"

int main(int argc, char** argv) {
    dermis::cli::CommandLine line("dermis " DERMIS_VERSION,
                                  "Human skin in real time: renders it with several techniques, bakes their "
                                  "tables, measures them against a ground truth.",
                                  "dermis render scenes/spheres.toml --technique lambert -o out/spheres.png");
    dermis::cli::add_all_commands(line);
    if (const std::optional<int> exit_code = line.parse(argc, argv)) return *exit_code;
    const dermis::Result<int> exit_code = line.action();
    if (!exit_code) {
        dermis::cli::print_message(exit_code.error().message);
        return 1;
    }
    return *exit_code;
}
