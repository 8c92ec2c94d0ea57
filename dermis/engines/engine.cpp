#include "dermis/engines/engine.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>

#include "dermis/base/file.h"
#include "dermis/base/hash.h"
#include "dermis/engines/head_maps.h"

namespace dermis::inline engines {
namespace {

// Unity: a package with a .meta file beside each file and folder, from the texts of engines/unity_meta. A
// GUID is a hash of the path, so that a later version of the package replaces an earlier one in place.
constexpr std::string_view kTable = "Runtime/SkinTable.exr", kUnityHead = "Head/",
                           kGodotHead = "addons/dermis_skin/head/";

std::string guid_of(std::string_view path) {
    return Hasher().add("com.dermis.skin/").add(path).hex();
}

void add_unity_words(const PackageInput& input, Words& words) {
    words["guid_of_shader"] = guid_of("Runtime/Skin.shader");
    words["guid_of_table"] = guid_of(kTable);
    // The first version whose reader keeps exactly eight sets of texture coordinates; a head has six.
    words["dependencies"] = input.head.empty() ? "" : "\"com.unity.cloud.gltfast\": \"6.14.1\"";
}

// The importer's settings are of the kind of file. Of a head, scene.json is a text and all maps have mip
// levels, but the table.
std::string import_kind(const std::string& path, std::string_view head_path) {
    const std::string kind = path.substr(path.rfind('.') + 1);
    if (!path.starts_with(head_path)) return kind;
    if (path.ends_with(kReflectedShares)) return kind;
    return kind == "json" ? "md" : kind == "exr" ? "png" : kind;
}

// Of a head's pictures only the albedo is a colour; what lies over the atlas is clamped.
Words meta_words(const std::string& path) {
    const bool is_albedo = path.ends_with("_albedo.png");
    const bool over_atlas = path.ends_with("thickness.png") || path.find("/normals_") != std::string::npos;
    return {{"guid", guid_of(path)}, {"srgb", is_albedo ? "1" : "0"}, {"wrap", over_atlas ? "1" : "0"}};
}

// Unity does not import what is in a folder whose name ends in '~'; what is in Samples~ is copied with its
// .meta files.
bool has_meta(const std::string& path) {
    return !path.starts_with("Documentation~") && path != "Samples~";
}

std::set<std::string> folders_of(const std::vector<PackageFile>& files) {
    std::set<std::string> folders;
    for (const PackageFile& file : files)
        for (size_t at = 0; (at = file.path.find('/', at)) != std::string::npos; ++at)
            folders.insert(file.path.substr(0, at));
    return folders;
}

Result<void> add_meta_files(const PackageInput& input, std::vector<PackageFile>& files) {
    std::vector<std::pair<std::string, std::string>> targets;  // path, kind
    for (const PackageFile& file : files) targets.emplace_back(file.path, import_kind(file.path, kUnityHead));
    for (const std::string& folder : folders_of(files)) targets.emplace_back(folder, "folder");
    for (const auto& [path, kind] : targets) {
        if (!has_meta(path)) continue;
        const auto found = std::ranges::find(input.templates, "engines/unity_meta/" + kind + ".meta",
                                             &PackageTemplate::path);
        if (found == input.templates.end())
            return Error{"engines/unity_meta has no " + kind + ".meta, which " + path + " needs"};
        DERMIS_TRY_ASSIGN(const std::string text, filled(*found, meta_words(path)));
        files.push_back({path + ".meta", to_bytes(text)});
    }
    return {};
}

// Godot: import settings beside each picture and mesh of a head, from the texts of engines/godot_import.
Result<void> add_import_files(const PackageInput& input, std::vector<PackageFile>& files) {
    const size_t count = files.size();
    for (size_t i = 0; i < count; ++i) {
        const std::string path = files[i].path;
        if (!path.starts_with(kGodotHead)) continue;
        const auto found = std::ranges::find(
            input.templates, "engines/godot_import/" + import_kind(path, kGodotHead) + ".import",
            &PackageTemplate::path);
        if (found == input.templates.end()) continue;
        const bool is_full_size = path.ends_with(kReflectedShares) || path.ends_with(kReflections);
        DERMIS_TRY_ASSIGN(const std::string text,
                          filled(*found, {{"path", path}, {"has_levels", is_full_size ? "false" : "true"}}));
        files.push_back({path + ".import", to_bytes(text)});
    }
    return {};
}

}  // namespace

const std::vector<Engine>& all_engines() {
    static const std::vector<Engine> all = {
        {.name = "unity",
         .texts = {{"Runtime/Skin.hlsl", shading::Language::hlsl}},
         .license_path = "LICENSE.md",
         .picture_path = "Documentation~/picture.png",
         .head_path = kUnityHead,
         .head_format = {.map_files = true, .ambient_probe = true, .reflected_shares = true},
         .hlsl_path = kUnityHead,
         .table_path = kTable,
         .v_origin = VOrigin::bottom,
         .add_words = add_unity_words,
         .add_files = add_meta_files},
        // Unreal Engine 5 keeps import settings in binary assets; a Python script of the plugin sets them.
        {.name = "unreal",
         .texts = {{"DermisSkin/Shaders/Skin.ush", shading::Language::hlsl}},
         .license_path = "DermisSkin/LICENSE",
         .head_path = "DermisSkin/Head/",
         .head_format =
             {.map_files = true, .reflected_shares = true, .reflections = true, .still_maps = true},
         .hlsl_path = "DermisSkin/Shaders/",
         .hlsl_extension = ".ush",
         .table_path = "DermisSkin/Resources/SkinTable.exr",
         .v_origin = VOrigin::top},
        // Godot 4: the .import and .tres files are text and come from engines/godot.
        {.name = "godot",
         .texts = {{"addons/dermis_skin/skin.gdshaderinc", shading::Language::gdshader}},
         .license_path = "addons/dermis_skin/LICENSE",
         .head_path = kGodotHead,
         // Its importer interpolates rotations of cubic splines as linear keys.
         .head_format =
             {.map_files = true, .linear_keys = true, .reflected_shares = true, .reflections = true},
         .table_path = "addons/dermis_skin/skin_table.exr",
         .v_origin = VOrigin::top,
         .add_files = add_import_files},
        // three.js has the last row of an EXR picture at v = 0.
        {.name = "three",
         .texts = {{"skin.js", shading::Language::essl, "glslText"},
                   {"skin.js", shading::Language::wgsl, "wgslText"}},
         .head_path = "head/",
         .takes_scripts = true,
         .table_path = "skin_table.exr",
         .v_origin = VOrigin::bottom},
        // Babylon.js: its reader of EXR fetches a library from another host, so the table is DDS, whose first
        // row is at v = 0 there.
        {.name = "babylon",
         .texts = {{"skin.js", shading::Language::essl, "glslText"},
                   {"skin.js", shading::Language::wgsl, "wgslText"}},
         .head_path = "head/",
         .takes_scripts = true,
         .table_path = "skin_table.dds",
         .v_origin = VOrigin::top}};
    return all;
}

}  // namespace dermis::inline engines
