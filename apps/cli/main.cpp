// dermis: parses, calls, prints. What a command does is in dermis/.

#include <cstdio>

#include "command.h"
#include "dermis/base/text.h"

namespace {

// CLI11 would say only that a subcommand is missing.
std::string unknown_command(const CLI::App& app, int argc, char** argv) {
    if (argc < 2 || argv[1][0] == '-') return "";
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    for (const std::string& name : names)
        if (name == argv[1]) return "";
    return dermis::unknown_name("command", argv[1], names);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Human skin in real time: renders skin with published techniques, bakes their tables, measures them.", "dermis");
    app.set_version_flag("--version", "dermis " DERMIS_VERSION);
    app.require_subcommand(1);
    app.footer("Example:\n  dermis render scenes/spheres.toml --technique lambert -o out/spheres.png");
    dermis::cli::CommandLine line{app, {}};
    dermis::cli::add_all_commands(line);

    if (const std::string unknown = unknown_command(app, argc, argv); !unknown.empty()) {
        std::fprintf(stderr, "dermis: %s\n", unknown.c_str());
        return 2;
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& done) {  // --help, --version
        return app.exit(done);
    } catch (const CLI::ParseError& wrong) {
        std::fprintf(stderr, "dermis: %s (see dermis --help)\n", wrong.what());
        return 2;
    }
    const dermis::Result<int> exit_code = line.action();
    if (!exit_code) {
        std::fprintf(stderr, "dermis: %s\n", exit_code.error().message.c_str());
        return 1;
    }
    return *exit_code;
}
