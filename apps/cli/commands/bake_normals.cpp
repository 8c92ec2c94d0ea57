// `dermis bake normals`: what preintegrated draws with, as files.

#include <cstdio>
#include <memory>

#include "bake_options.h"
#include "catalog/catalog.h"
#include "dermis/base/text.h"
#include "dermis/mesh/read_mesh.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"
#include "dermis/rays/diffused_normals_file.h"
#include "dermis/render/atlas_check.h"
#include "dermis/scene/load_scene.h"
#include "map_layout.h"
#include "pose_choice.h"
#include "scene_choice.h"

namespace dermis::cli {
namespace {

struct BakeNormalsOptions {
    std::string mesh, output, profile;
    float unit_mm = 0;
    PoseChoice pose;
    int size = DiffusedNormalsRequest{}.size;
};

Result<FileUse> files_of(const BakeNormalsOptions& options) {
    FileUse files = {.inputs = {options.mesh, options.profile}};
    for (const auto& path : diffused_normals_paths(options.output)) {
        DERMIS_TRY(check_diffused_normals_path(path));
        files.outputs.insert(files.outputs.end(), {path, path.string() + ".json"});
    }
    files.outputs.push_back(atlas_mesh_path(options.output));
    return files;
}

Result<int> run(const BakeNormalsOptions& options) {
    SceneOptions how = {.subjects = built_in_catalog().subjects};
    if (options.unit_mm > 0 && !is_mesh_file(options.mesh))
        return Error{"--unit-mm is for mesh files; " + options.mesh +
                     " states the unit of each of its meshes"};
    if (options.unit_mm > 0) how.mesh_unit_mm = options.unit_mm;
    DERMIS_TRY_ASSIGN(how.words, options.pose.words());
    DERMIS_TRY_ASSIGN(Scene scene, load_scene(options.mesh, how));
    DERMIS_TRY(keep_scene_files(scene, files_of(options)));
    DERMIS_TRY_ASSIGN(const LayoutOfMap layout, lay_out_map(scene, {}));
    const std::string profile_name = options.profile.empty() ? scene.skin.profile : options.profile;
    const Result<Profile> profile = find_profile(profile_name);
    if (!profile) return profile.error();
    DERMIS_TRY_ASSIGN(const std::vector<std::string> warnings, check_skin_atlas(scene));
    const DiffusedNormalsOrigin origin = {.mesh = options.mesh,
                                          .profile_name = profile_name,
                                          .profile = to_gaussian_sum(*profile).sum,
                                          .request = {.size = options.size},
                                          .uv_file = atlas_mesh_name(layout, options.output)};
    DERMIS_TRY_ASSIGN(const DiffusedNormals normals,
                      bake_diffused_normals(scene, origin.profile, origin.request));
    DERMIS_TRY(write_diffused_normals(options.output, normals, origin));
    print_warnings(warnings);
    for (const auto& path : diffused_normals_paths(options.output)) print_path(path);
    DERMIS_TRY(deliver_layout(scene, layout, options.output));
    return 0;
}

}  // namespace

void add_bake_normals_command(CommandLine& line) {
    auto options = std::make_shared<BakeNormalsOptions>();
    Command* command = line.add("normals", "Mean of the normals that each colour's scattering covers",
                                "dermis bake normals head_scan --profile gpu_gems_3 -o normals.exr\n"
                                "  dermis bake normals head.obj --unit-mm 45 --size 2048 -o normals.png",
                                bake_group(line));
    command->add_option("MESH", options->mesh, "mesh, scene file, scene name or builtin:NAME")->required();
    command
        ->add_output("-o,--output", options->output,
                     "NAME.exr or NAME.png: writes NAME_red and NAME_green, and a .json beside each")
        ->required();
    command->add_option("--profile", options->profile, "diffusion profile instead of the scene's");
    command->add_option("--size", options->size, {16, 8192}, "side of the maps in texels")
        ->capture_default_str();
    command->add_option("--unit-mm", options->unit_mm, kUnitRangeMm,
                        "length of one unit of the mesh file in mm");
    options->pose.add_to(*command);
    line.when_chosen(
        command, [options] { return files_of(*options); }, [options] { return run(*options); });
}

}  // namespace dermis::cli
