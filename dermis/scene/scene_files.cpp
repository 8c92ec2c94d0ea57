#include "dermis/scene/scene_files.h"

#include <algorithm>
#include <cstdlib>
#include <set>

#include "dermis/base/text.h"
#include "dermis/optics/presets.h"

namespace dermis::inline scene {
namespace fs = std::filesystem;
namespace {

constexpr ImageSource Material::*kMaps[] = {
    &Material::base_color_map,         &Material::emission_map,        &Material::normal_map,
    &Material::metallic_roughness_map, &Material::specular_map,        &Material::occlusion_map,
    &Material::displacement_map,       &Material::thickness_map,       &Material::opacity_map,
    &Material::transmission_map,       &Material::roughness_map,       &Material::metallic_map,
    &Material::curvature_map,          &Material::kernel_size_map,     &Material::alpha_map,
    &Material::wrinkle_stretch_map,    &Material::wrinkle_compress_map};

bool is_on_disk(const ImageSource& source) {
    return !source.name.empty() && source.encoded.empty() && source.pixels.empty();
}

void add_maps(const MapsDescription& maps, std::vector<const NamedFile*>& files) {
    for (const auto& [key, map] : maps.files) files.push_back(&map.file);
}

}  // namespace

std::vector<fs::path> files_of(const Scene& scene) {
    std::vector<fs::path> files = scene.files;
    for (const SceneObject& object : scene.objects)
        for (const Material& material : object.mesh.materials)
            for (const auto map : kMaps)
                if (is_on_disk(material.*map)) files.emplace_back((material.*map).name);
    if (scene.environment.kind == EnvironmentKind::file) files.push_back(scene.environment.file);
    for (const std::string& table :
         {scene.skin.diffuse_table, scene.skin.zonal_table, scene.skin.beckmann_table})
        if (!table.empty()) files.emplace_back(table);
    for (const auto& [target, map] : scene.skin.blood_by_target) files.emplace_back(map);
    if (is_profile_file(scene.skin.profile)) files.emplace_back(scene.skin.profile);
    for (const SceneObject& object : scene.objects)
        for (const Material& material : object.mesh.materials)
            if (is_profile_file(material.profile)) files.emplace_back(material.profile);
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
    for (const auto& [target, file] : description.blood_by_target) files.push_back(&file);
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

namespace {

constexpr std::string_view kAssets = "assets:";

fs::path from_environment(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

fs::path data_directory() {
    if (const fs::path xdg = from_environment("XDG_DATA_HOME"); !xdg.empty()) return xdg / "dermis";
    if (const fs::path home = from_environment("HOME"); !home.empty())
        return home / ".local" / "share" / "dermis";
    return {};
}

// The data folder that `cmake --install` puts beside the program; empty when the program is not installed.
fs::path installed_data() {
    std::error_code ec;
    const fs::path program = fs::read_symlink("/proc/self/exe", ec);
    const fs::path data = (program.parent_path() / ".." / "share" / "dermis").lexically_normal();
    return !ec && fs::is_directory(data, ec) ? data : fs::path();
}

Result<fs::path> resolve_asset(std::string_view name) {
    std::vector<std::string> looked;
    for (const fs::path& directory : asset_directories()) {
        std::error_code ec;
        if (const fs::path file = directory / name; fs::is_regular_file(file, ec)) return file;
        looked.push_back(directory.string());
    }
    const fs::path data = installed_data();
    const std::string get_head = data.empty() ? "tools/get_head" : (data / "get_head").string();
    return Error{"asset '" + std::string(name) + "' is in none of " + join(looked, ", ") + "; run " +
                 get_head + ", or set DERMIS_ASSETS to the directory that holds it"};
}

}  // namespace

bool is_asset(std::string_view text) {
    return text.starts_with(kAssets);
}

std::vector<fs::path> asset_directories() {
    std::vector<fs::path> directories;
    if (const fs::path own = from_environment("DERMIS_ASSETS"); !own.empty()) directories.push_back(own);
    directories.push_back((fs::path(DERMIS_SOURCE_DIR) / ".." / "shared" / "assets").lexically_normal());
    if (const fs::path data = data_directory(); !data.empty()) directories.push_back(data);
    return directories;
}

Result<fs::path> resolve_path(std::string_view text, const fs::path& scene_file) {
    if (is_asset(text)) return resolve_asset(text.substr(kAssets.size()));
    const fs::path path = (scene_file.parent_path() / text).lexically_normal();
    std::error_code ec;
    if (fs::is_directory(path, ec)) return Error{"'" + path.string() + "' is a directory, not a file"};
    if (!fs::exists(path, ec))
        return Error{"'" + path.string() + "' does not exist; paths are relative to the " +
                     (scene_file.empty() ? "current directory" : "scene file")};
    return path;
}

fs::path source_directory() {
    std::error_code ec;
    return fs::is_directory(DERMIS_SOURCE_DIR, ec) ? fs::path(DERMIS_SOURCE_DIR) : fs::path();
}

std::vector<fs::path> scene_directories() {
    std::vector<fs::path> directories;
    if (const fs::path data = installed_data(); !data.empty()) directories.push_back(data / "scenes");
    directories.push_back(fs::path(DERMIS_SOURCE_DIR) / "scenes");
    return directories;
}

std::vector<std::string> scene_names() {
    std::set<std::string> names;
    for (const fs::path& directory : scene_directories()) {
        std::error_code ec;
        for (const fs::directory_entry& entry : fs::directory_iterator(directory, ec))
            if (entry.path().extension() == ".toml") names.insert(entry.path().stem().string());
    }
    return {names.begin(), names.end()};
}

fs::path find_scene(std::string_view name) {
    for (const fs::path& directory : scene_directories()) {
        std::error_code ec;
        const fs::path file = directory / (std::string(name) + ".toml");
        if (fs::is_regular_file(file, ec)) return file;
    }
    return {};
}

}  // namespace dermis::inline scene
