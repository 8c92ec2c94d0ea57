// `dermis bake normals`: what preintegrated draws with, as files.

#include <memory>

#include "bake_options.h"
#include "normals_options.h"

namespace dermis::cli {
namespace {

struct BakeNormals {
    NormalsOptions normals;
    std::string output;
};

Result<int> run(const BakeNormals& options) {
    DERMIS_TRY_ASSIGN(const MadeNormals made, options.normals.make(options.normals.files(options.output)));
    DERMIS_TRY(write_normals(options.output, made));
    print_warnings(made.warnings);
    for (const auto& path : diffused_normals_paths(options.output)) print_path(path);
    DERMIS_TRY(deliver_layout(made.scene, made.layout, options.output));
    return 0;
}

}  // namespace

void add_bake_normals_command(CommandLine& line) {
    auto options = std::make_shared<BakeNormals>();
    Command* command = line.add("normals", "Mean of the normals that each colour's scattering covers",
                                "dermis bake normals head_scan --profile gpu_gems_3 -o normals.exr\n"
                                "  dermis bake normals head.obj --unit-mm 45 --size 2048 -o normals.png",
                                bake_group(line));
    command->add_option("MESH", options->normals.mesh, "mesh, scene file, scene name or builtin:NAME")
        ->required();
    command
        ->add_output("-o,--output", options->output,
                     "NAME.exr or NAME.png: writes NAME_red and NAME_green, and a .json beside each")
        ->required();
    command->add_option("--profile", options->normals.profile, "diffusion profile instead of the scene's");
    command->add_option("--size", options->normals.size, kNormalsSizeRange, "side of the maps in texels")
        ->capture_default_str();
    command->add_option("--unit-mm", options->normals.unit_mm, kUnitRangeMm,
                        "length of one unit of the mesh file in mm");
    options->normals.pose.add_to(*command);
    line.when_chosen(
        command, [options] { return options->normals.files(options->output); },
        [options] { return run(*options); });
}

}  // namespace dermis::cli
