#include <cstdio>
#include <memory>

#include "command.h"
#include "dermis/bake/lint.h"
#include "dermis/bake/table_io.h"
#include "dermis/base/text.h"
#include "dermis/rays/map_file.h"

namespace dermis::cli {
namespace {

struct LintOptions {
    std::string path;
    bool write_sidecar = false;
};

Result<int> run(const LintOptions& options) {
    const std::string& path = options.path;
    DERMIS_TRY_ASSIGN(const std::optional<std::string> map, describe_map(path));
    if (map && options.write_sidecar) return Error{path + ": has the sidecar of a map already"};
    if (map) {
        print_path(path);
        std::printf("  %s\n", printable_line(*map).c_str());
        return 0;
    }
    DERMIS_TRY_ASSIGN(const LintReport report, lint_file(path));
    print_path(path);
    for (const std::string& line : report.findings) std::printf("  %s\n", line.c_str());
    for (const std::string& line : report.advice) std::printf("  -> %s\n", line.c_str());
    if (options.write_sidecar) {
        DERMIS_TRY_ASSIGN(const auto sidecar, write_sidecar(path, report));
        print_path(sidecar);
    }
    return report.explained ? 0 : 1;
}

}  // namespace

void add_lint_command(CommandLine& line) {
    auto options = std::make_shared<LintOptions>();
    Command* command = line.add("lint", "Finds what a table is, how it was made, and its error",
                                "dermis lint DiffuseScatteringOnRing.png --write-sidecar");
    command
        ->add_option("FILE", options->path, "PNG, EXR, DDS, KTX2, or CSV with n_dot_l,curvature_per_mm,r,g,b")
        ->required();
    command->add_flag("--write-sidecar", options->write_sidecar,
                      "write the convention to FILE.json, so that diffuse_table accepts the table");
    line.when_chosen(
        command,
        [options] {
            FileUse files = {.outputs = {}, .inputs = {options->path}};
            if (options->write_sidecar) files.outputs.push_back(sidecar_path(options->path));
            return Result<FileUse>(files);
        },
        [options] { return run(*options); });
}

}  // namespace dermis::cli
