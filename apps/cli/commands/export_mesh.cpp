#include <cstdio>
#include <memory>

#include "command.h"
#include "dermis/base/text.h"
#include "dermis/bust/bust.h"
#include "dermis/bust/export.h"

namespace dermis::cli {
namespace {

constexpr std::string_view kBuiltin = "builtin:";

struct Options {
    std::string mesh = "builtin:bust", path, maps;
    BustParams params;
};

Result<int> run(const Options& options) {
    const std::string_view text = options.mesh;
    const std::string name(text.starts_with(kBuiltin) ? text.substr(kBuiltin.size()) : text);
    if (name != "bust") return Error{unknown_name("built-in mesh", name, std::vector<std::string>{"bust"})};
    const Result<Bust> bust = make_bust(options.params);
    if (!bust) return bust.error();
    if (const auto written = write_bust(options.path, *bust); !written) return written.error();
    if (!options.maps.empty())
        if (const auto written = write_bust_maps(options.maps, *bust); !written) return written.error();
    std::printf("%s: %zu triangles\n", options.path.c_str(), bust->mesh.triangle_count());
    return 0;
}

// head_width_mm -> --head-width-mm
std::string flag_of(std::string_view name) {
    std::string flag = "--" + std::string(name);
    for (char& c : flag)
        if (c == '_') c = '-';
    return flag;
}

}  // namespace

void add_export_mesh_command(CommandLine& line) {
    auto options = std::make_shared<Options>();
    Command* command = line.add("export-mesh", "The built-in head with its skin, as GLB or OBJ",
                                "dermis export-mesh builtin:bust -o bust.glb\n"
                                "  dermis export-mesh builtin:bust --tone 5 --maps maps/ -o bust.obj");
    command->add_option("mesh", options->mesh, "builtin:bust");
    command->add_option("-o,--output", options->path, "file to write, .glb or .obj")->required();
    command->add_option("--maps", options->maps, "folder for all maps as PNG, the kernel size among them");
    command->add_option("--seed", options->params.seed,
                        "pores, freckles, brows, which way the asymmetry goes");
    for (const BustParamInfo& row : bust_param_table())
        command->add_option(flag_of(row.name), options->params.*row.member,
                            std::string(row.doc) + ", " + to_text(row.least) + " to " + to_text(row.most) +
                                (row.unit.empty() ? "" : " " + std::string(row.unit)));
    line.when_chosen(command, [options] { return run(*options); });
}

}  // namespace dermis::cli
