// dermis: parses, calls, prints. What a command does is in dermis/.

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "command.h"
#include "dermis/base/file.h"
#include "end_on_failure.h"

namespace dermis::cli {
namespace {

int run(int argc, char** argv) {
    CommandLine line("dermis " DERMIS_VERSION,
                     "Human skin in real time: renders it with several techniques, bakes their tables, "
                     "measures them against a reference.",
                     "dermis render scenes/spheres.toml --technique lambert -o out/spheres.png");
    add_all_commands(line);
    if (const std::optional<int> exit_code = line.parse(argc, argv)) return *exit_code;
    const Result<int> exit_code = line.action();
    if (exit_code) return *exit_code;
    print_message(exit_code.error().message);
    return 1;
}

}  // namespace
}  // namespace dermis::cli

int main(int argc, char** argv) {
    std::signal(SIGXFSZ, SIG_IGN);  // a write beyond the limit on file sizes is then an error like any other
    dermis::remove_temporary_files_on_signals();
    dermis::cli::end_on_failure();  // the libraries return errors as values; only failing memory and threads
                                    // throw
    const int exit_code = dermis::cli::run(argc, argv);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_code;
    dermis::cli::print_message(std::string("standard output: cannot write: ") + std::strerror(errno));
    return exit_code == 0 ? 1 : exit_code;
}
