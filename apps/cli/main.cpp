// dermis: parses, calls, prints. What a command does lives in src/.

#include <cstdio>

#include "command.h"

int main(int argc, char** argv) {
    CLI::App app("Human skin in real time: renders, bakes and measures every published technique.", "dermis");
    app.set_version_flag("--version", "dermis " DERMIS_VERSION);
    app.require_subcommand(1);
    app.footer("Example:\n  dermis render scenes/spheres.toml --technique lambert -o out/spheres.png");
    dermis::cli::CommandLine line{app, {}};
    dermis::cli::add_all_commands(line);

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
