// dermis new-scene MESH -o FILE.toml: a scene file that renders as it is.

#include <cstdio>
#include <memory>

#include "catalog/catalog.h"
#include "command.h"
#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/mesh/read_mesh.h"
#include "dermis/scene/load_scene.h"
#include "dermis/scene/new_scene.h"

namespace dermis::cli {
namespace {

struct NewSceneOptions {
    std::string mesh, output;
    double unit_mm = 0;
};

Result<FileUse> files_of(const NewSceneOptions& options) {
    if (!is_mesh_file(options.mesh))
        return Error{options.mesh + ": not a mesh file; give a .glb, .gltf or .obj"};
    if (!to_lower(options.output).ends_with(".toml"))
        return Error{"-o " + options.output + ": a scene file ends with .toml"};
    return FileUse{.outputs = {options.output}, .inputs = {options.mesh}};
}

Result<int> run(const NewSceneOptions& options) {
    SceneOptions how = {.subjects = built_in_catalog().subjects};
    if (options.unit_mm > 0) how.mesh_unit_mm = float(options.unit_mm);
    DERMIS_TRY_ASSIGN(const Scene scene, load_scene(options.mesh, how));
    DERMIS_TRY_ASSIGN(const NewScene made, new_scene(scene, options.mesh, options.output));
    DERMIS_TRY(write_text_file(options.output, made.toml));
    print_warnings(scene.warnings);
    print_path(options.output);
    for (const std::string& text : made.taken) std::printf("  %s\n", printable_line(text).c_str());
    std::printf("  fill in `credit`, then: dermis render %s\n", printable_line(options.output).c_str());
    return 0;
}

}  // namespace

void add_new_scene_command(CommandLine& line) {
    const auto options = std::make_shared<NewSceneOptions>();
    Command* command =
        line.add("new-scene", "Writes a scene file for a mesh: unit, classes, maps, lights, camera",
                 "dermis new-scene head.glb -o head.toml");
    command->add_option("MESH", options->mesh, ".glb, .gltf or .obj")->required();
    command->add_output("-o,--output", options->output, "scene file to write, .toml")->required();
    command->add_option(
        "--unit-mm", options->unit_mm, kUnitRangeMm,
        "length of one unit of the mesh file in mm (default: glTF 1000, OBJ 1, or what makes it as "
        "tall as a head)");
    line.when_chosen(
        command, [options] { return files_of(*options); }, [options] { return run(*options); });
}

}  // namespace dermis::cli
