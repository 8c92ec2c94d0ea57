#include "posed_mesh.h"

#include <cstdio>

#include "dermis/base/text.h"
#include "dermis/mesh/read_mesh.h"
#include "dermis/mesh/write_mesh.h"
#include "dermis/scene/scene_description.h"
#include "scene_choice.h"

namespace dermis::cli {
namespace fs = std::filesystem;

void MeshFileChoice::add_to(Command& command) {
    pose.add_to(command);
    command.add_option("--unit-mm", unit_mm, kUnitRangeMm,
                       "length of one unit of the mesh file in mm (default: glTF 1000, OBJ 1)");
}

Result<FileUse> files_of_posed_mesh(const std::string& mesh, const fs::path& output) {
    const std::string extension = to_lower(output.extension().string());
    if (extension != ".obj" && extension != ".glb")
        return Error{output.string() + ": the mesh is written as .obj or .glb"};
    FileUse files = {.outputs = {output}, .inputs = {mesh}};
    if (extension == ".obj") files.outputs.push_back(mtl_path(output));
    return files;
}

Result<int> export_posed_mesh(const std::string& mesh, const fs::path& output, const MeshFileChoice& choice) {
    SceneDescription description;
    DERMIS_TRY_ASSIGN(const std::vector<SceneWord> words, choice.pose.words());
    for (const SceneWord& word : words) DERMIS_TRY(set_word(description, word, {}));
    MeshOptions options = {.pose = description.motion.pose(), .keep_vertices = true};
    if (choice.unit_mm > 0) options.unit_mm = choice.unit_mm;
    DERMIS_TRY_ASSIGN(const LoadedMesh loaded, read_mesh(mesh, options));
    if (const auto checked = check_pose(options.pose, {&loaded.motion, 1}); !checked)
        return checked.error().within(mesh);
    print_warnings(loaded.warnings);
    const bool is_obj = to_lower(output.extension().string()) == ".obj";
    DERMIS_TRY(is_obj ? write_obj(output, loaded.mesh) : write_glb(output, loaded.mesh));
    std::printf("%s: %zu vertices, %zu triangles\n", printable_line(output.string()).c_str(),
                loaded.mesh.positions_mm.size(), loaded.mesh.triangle_count());
    return 0;
}

}  // namespace dermis::cli
