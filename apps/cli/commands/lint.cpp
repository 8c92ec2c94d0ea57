#include <cstdio>
#include <memory>

#include "command.h"
#include "dermis/bake/lint.h"

namespace dermis::cli {
namespace {

Result<int> run(const std::string& path) {
    const Result<LintReport> report = lint_file(path);
    if (!report) return report.error();
    std::printf("%s\n", path.c_str());
    for (const std::string& line : report->findings) std::printf("  %s\n", line.c_str());
    for (const std::string& line : report->advice) std::printf("  -> %s\n", line.c_str());
    return report->explained ? 0 : 1;
}

}  // namespace

void add_lint_command(CommandLine& line) {
    auto path = std::make_shared<std::string>();
    Command* command = line.add("lint", "Finds how a pre-integrated table was made, and its error",
                                "dermis lint DiffuseScatteringOnRing.png");
    command->add_option("file", *path, "PNG, EXR, DDS or KTX2")->required();
    line.when_chosen(command, [path] { return run(*path); });
}

}  // namespace dermis::cli
