#pragma once
// Runs the command line as a user does.

#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace dermis {

struct ProgramResult {
    int exit_code = -1;  ///< 128 + signal when it was killed
    std::string out, err;
};

inline std::string slurp(const std::string& path) {
    std::string text;
    if (std::FILE* file = std::fopen(path.c_str(), "r")) {
        char buffer[4096];
        for (size_t got; (got = std::fread(buffer, 1, sizeof buffer, file)) > 0;) text.append(buffer, got);
        std::fclose(file);
    }
    return text;
}

/// A shell line; standard output and error apart.
inline ProgramResult run_shell(const std::string& line, const std::string& scratch) {
    const std::string out = scratch + "/stdout.txt", err = scratch + "/stderr.txt";
    const int status = std::system(("{ " + line + " ; } >" + out + " 2>" + err + " </dev/null").c_str());
    ProgramResult result;
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    result.out = slurp(out);
    result.err = slurp(err);
    return result;
}

/// Whether the shell finds the program.
inline bool has_program(const std::string& name) {
    return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
}

}  // namespace dermis
