#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>

#include "command.h"
#include "dermis/base/text.h"
#include "dermis/mesh/write_mesh.h"
#include "dermis/optics/gltf_profile.h"
#include "dermis/optics/presets.h"
#include "dermis/scene/subject.h"
#include "parameter_list.h"
#include "posed_mesh.h"
#include "profile_options.h"
#include "subjects/bust/bust.h"
#include "subjects/bust/export.h"

namespace dermis::cli {
namespace {

struct ExportMeshOptions {
    MeshFileChoice posed;
    std::string mesh = "builtin:bust", path, maps, profile = "gpu_gems_3";
    std::map<std::string, std::optional<std::string>> parameters;
};

Result<FileUse> files_of(const ExportMeshOptions& options) {
    const std::filesystem::path path = options.path;
    if (is_mesh_file(options.mesh)) return files_of_posed_mesh(options.mesh, path);
    DERMIS_TRY(check_bust_path(path));
    FileUse files = {.outputs = {path}, .inputs = {options.profile}};
    if (to_lower(path.extension().string()) == ".obj") files.outputs.push_back(mtl_path(path));
    if (!options.maps.empty())
        for (const std::string_view name : kBustMaps)
            files.outputs.push_back(std::filesystem::path(options.maps) / name);
    return files;
}

// head_width_mm -> --head-width-mm
std::string flag_of(std::string_view name) {
    std::string flag = "--" + std::string(name);
    for (char& c : flag)
        if (c == '_') c = '-';
    return flag;
}

Result<int> run(const ExportMeshOptions& options) {
    if (is_mesh_file(options.mesh)) {
        const auto given =
            std::ranges::find_if(options.parameters, [](const auto& p) { return bool(p.second); });
        if (given != options.parameters.end() || !options.maps.empty())
            return Error{(options.maps.empty() ? flag_of(given->first) : "--maps") +
                         " is for builtin:bust, not for " + options.mesh};
        return export_posed_mesh(options.mesh, options.path, options.posed);
    }
    const std::string name(subject_name(options.mesh).value_or(options.mesh));
    if (name != "bust") return Error{unknown_name("built-in mesh", name, std::vector<std::string>{"bust"})};
    ParameterValues values(bust_parameters());
    for (const auto& [parameter, text] : options.parameters)
        if (text) DERMIS_TRY(values.set(parameter, *text));
    const Result<Profile> profile = find_profile(options.profile);
    if (!profile) return Error{"--profile: " + profile.error().message};
    DERMIS_TRY_ASSIGN(const Bust bust, make_bust(values.as<BustParams>()));
    DERMIS_TRY(write_bust(options.path, bust, *profile, options.maps));
    std::printf("%s: %zu triangles\n", printable_line(options.path).c_str(), bust.mesh.triangle_count());
    const bool is_obj = to_lower(options.path).ends_with(".obj");
    std::printf("  %s\n", is_obj ? "OBJ has no place for the profile and for maps of specular and kernel size"
                                 : gltf_note(*profile).c_str());
    return 0;
}

}  // namespace

void add_export_mesh_command(CommandLine& line) {
    auto options = std::make_shared<ExportMeshOptions>();
    Command* command = line.add(
        "export-mesh", "Writes the built-in head with its skin, or a mesh file in a pose, as GLB or OBJ",
        "dermis export-mesh builtin:bust -o bust.glb\n"
        "  dermis export-mesh builtin:bust --tone 5 --profile openpbr_skin_5 -o dark.glb\n"
        "  dermis export-mesh head.glb --clip talk --time 1.2 -o posed.obj");
    command->add_option("MESH", options->mesh,
                        "builtin:bust, or a mesh file: every vertex in its order, in mm");
    options->posed.add_to(*command);
    command->add_output("-o,--output", options->path, "file to write, .glb or .obj")->required();
    command->add_option("--profile", options->profile,
                        "of the GLB's material: " + std::string(kProfileNames));
    command->add_output("--maps", options->maps, "folder for all maps as PNG, kernel size included");
    for (const Parameter& row : bust_parameters().parameters)
        command->add_option(flag_of(row.name), options->parameters[row.name],
                            row.doc + ", " + range_text(row));
    line.when_chosen(
        command, [options] { return files_of(*options); }, [options] { return run(*options); });
}

}  // namespace dermis::cli
