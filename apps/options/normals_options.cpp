#include "normals_options.h"

#include "catalog/catalog.h"
#include "dermis/mesh/read_mesh.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/presets.h"
#include "dermis/render/atlas_check.h"
#include "dermis/scene/load_scene.h"
#include "scene_choice.h"

namespace dermis::cli {

Result<FileUse> NormalsOptions::files(const std::string& output) const {
    FileUse files = {.outputs = {}, .inputs = {mesh, profile}};
    for (const auto& path : diffused_normals_paths(output)) {
        DERMIS_TRY(check_diffused_normals_path(path));
        files.outputs.insert(files.outputs.end(), {path, path.string() + ".json"});
    }
    files.outputs.push_back(atlas_mesh_path(output));
    return files;
}

Result<MadeNormals> NormalsOptions::make(const Result<FileUse>& files) const {
    SceneOptions how = {.subjects = built_in_catalog().subjects};
    if (unit_mm > 0 && !is_mesh_file(mesh))
        return Error{"--unit-mm is for mesh files; " + mesh + " states the unit of each of its meshes"};
    if (unit_mm > 0) how.mesh_unit_mm = unit_mm;
    DERMIS_TRY_ASSIGN(how.words, pose.words());
    MadeNormals made;
    DERMIS_TRY_ASSIGN(made.scene, load_scene(mesh, how));
    DERMIS_TRY(keep_scene_files(made.scene, files));
    DERMIS_TRY_ASSIGN(made.layout, lay_out_map(made.scene, {}));
    made.origin = {.mesh = mesh,
                   .profile_name = profile.empty() ? made.scene.skin.profile : profile,
                   .profile = {},
                   .request = {.size = size}};
    DERMIS_TRY_ASSIGN(const Profile found, find_profile(made.origin.profile_name));
    made.origin.profile = to_gaussian_sum(found).sum;
    DERMIS_TRY_ASSIGN(made.warnings, check_skin_atlas(made.scene));
    DERMIS_TRY_ASSIGN(made.normals,
                      bake_diffused_normals(made.scene, made.origin.profile, made.origin.request));
    return made;
}

Result<void> write_normals(const std::string& output, const MadeNormals& made) {
    DiffusedNormalsOrigin origin = made.origin;
    origin.uv_file = atlas_mesh_name(made.layout, output);
    return write_diffused_normals(output, made.normals, origin);
}

}  // namespace dermis::cli
