#include "dermis/scene/scene_files.h"

#include <algorithm>

#include "dermis/optics/presets.h"
#include "dermis/scene/scene_paths.h"

namespace dermis::inline scene {
namespace fs = std::filesystem;
namespace {

constexpr ImageSource Material::*kMaps[] = {
    &Material::base_color_map,         &Material::emission_map,    &Material::normal_map,
    &Material::metallic_roughness_map, &Material::specular_map,    &Material::occlusion_map,
    &Material::displacement_map,       &Material::thickness_map,   &Material::opacity_map,
    &Material::transmission_map,       &Material::roughness_map,   &Material::metallic_map,
    &Material::curvature_map,          &Material::kernel_size_map, &Material::alpha_map};

bool is_on_disk(const ImageSource& source) {
    return !source.name.empty() && source.encoded.empty() && source.pixels.empty();
}

void add_maps(const MapsDescription& maps, std::vector<const NamedFile*>& files) {
    for (const NamedFile* file :
         {&maps.albedo, &maps.normal, &maps.specular, &maps.roughness, &maps.occlusion, &maps.thickness,
          &maps.kernel_size, &maps.curvature, &maps.displacement, &maps.opacity})
        if (file->given()) files.push_back(file);
}

}  // namespace

std::vector<fs::path> files_of(const Scene& scene) {
    std::vector<fs::path> files = scene.files;
    for (const SceneObject& object : scene.objects)
        for (const Material& material : object.mesh.materials)
            for (const auto map : kMaps)
                if (is_on_disk(material.*map)) files.emplace_back((material.*map).name);
    if (scene.environment.kind == EnvironmentKind::file) files.push_back(scene.environment.file);
    for (const std::string& table : {scene.skin.diffuse_table, scene.skin.zonal_table})
        if (!table.empty()) files.emplace_back(table);
    if (is_profile_file(scene.skin.profile)) files.emplace_back(scene.skin.profile);
    std::sort(files.begin(), files.end());
    files.erase(std::unique(files.begin(), files.end()), files.end());
    return files;
}

Error error_at(const SceneDescription& description, const NamedFile& file, const std::string& message) {
    const std::string place =
        file.line > 0 ? description.file.string() + ":" + std::to_string(file.line) + ": " : "";
    return Error{place + file.key + ": " + message};
}

Result<fs::path> resolve_file(const SceneDescription& description, const NamedFile& file) {
    Result<fs::path> path = resolve_path(file.text, file.line > 0 ? description.file : fs::path());
    if (!path) return error_at(description, file, path.error().message);
    return path;
}

std::vector<const NamedFile*> named_files(const SceneDescription& description) {
    std::vector<const NamedFile*> files;
    for (const MeshDescription& mesh : description.meshes) files.push_back(&mesh.file);
    add_maps(description.maps, files);
    for (const auto& [name, material] : description.materials) add_maps(material.maps, files);
    if (description.environment && description.environment->file.given())
        files.push_back(&description.environment->file);
    return files;
}

std::vector<fs::path> paths_of(const SceneDescription& description) {
    std::vector<fs::path> paths;
    for (const NamedFile* file : named_files(description)) {
        if (const Result<fs::path> found = resolve_path(file->text, description.file))
            paths.push_back(*found);
        else if (file->text.find(':') == std::string::npos)
            paths.push_back((description.file.parent_path() / file->text).lexically_normal());
    }
    return paths;
}

}  // namespace dermis::inline scene
