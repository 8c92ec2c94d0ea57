// TOML to a description: walk the tree, look every key up in its section's table, check, set.

#include <algorithm>
#include <set>

#include "dermis/base/text.h"
#include "dermis/scene/scene_checks.h"
#include "dermis/scene/scene_keys.h"
#include "dermis/scene/toml_document.h"
#include "dermis/scene/toml_values.h"

namespace dermis {
namespace {

// Sets what the section's table knows; `nested` are tables inside it that somebody else reads.
template <class Target>
Result<void> read_section(const TomlNode& section, const std::string& path, const KeyTable<Target>& table,
                          Target& target, const TomlPlace& place, const std::set<std::string>& nested = {}) {
    std::vector<std::string> names(nested.begin(), nested.end());
    for (const Key<Target>& key : table.keys()) names.push_back(key.info.name);
    for (const TomlEntry& entry : section.entries) {
        if (nested.contains(entry.key)) continue;
        const auto key = std::ranges::find_if(table.keys(),
                                              [&](const Key<Target>& k) { return k.info.name == entry.key; });
        const TomlPlace here = place.at(entry.line);
        if (key == table.keys().end())
            return here.error(
                unknown_name(path.empty() ? "key" : "key in [" + path + "]:", entry.key, names));
        KeyValue value{.full_name = path.empty() ? entry.key : path + "." + entry.key, .line = entry.line};
        if (!read_toml_value(entry.value, key->info, value))
            return here.error(value.full_name + " = " + toml_text(entry.value) + ": " + entry.key + " " +
                              wanted_text(key->info));
        key->set(target, value);
    }
    return {};
}

Error no_table(const TomlNode& node, const std::string& path, const std::string& written,
               const TomlPlace& place) {
    return place.at(node.line).error(path + " is " + toml_kind(node) + ", not a table; write " + written);
}

template <class Target>
Result<void> read_table(const TomlNode& root, const std::string& name, const KeyTable<Target>& keys,
                        Target& target, const TomlPlace& place, const std::string& path_prefix = "") {
    const TomlNode* table = root.find(name);
    if (!table) return {};
    const std::string path = path_prefix + name;
    if (table->kind != TomlKind::table) return no_table(*table, path, "[" + path + "]", place);
    if constexpr (requires { target.line; }) target.line = table->line;
    return read_section(*table, path, keys, target, place);
}

Result<void> read_parameter(const TomlEntry& entry, const Parameter& parameter, MeshDescription& mesh,
                            const TomlPlace& here) {
    const KeyInfo info = key_info(parameter);
    if (KeyValue value; !read_toml_value(entry.value, info, value))
        return here.error("mesh." + entry.key + " = " + toml_text(entry.value) + ": " + entry.key + " " +
                          wanted_text(info));
    mesh.parameters[entry.key] = *setting_text(entry.value);
    return {};
}

// A [[mesh]] that names a subject has its parameters beside its own keys.
Result<void> read_mesh_section(const TomlNode& section, std::span<const Subject> subjects,
                               MeshDescription& mesh, const TomlPlace& place) {
    const TomlNode* file = section.find("file");
    const std::string mesh_text = file ? file->text : "this mesh";
    const auto name = subject_name(mesh_text);
    const auto is_named = [&](const Subject& subject) { return subject.name == name; };
    const auto named = std::ranges::find_if(subjects, is_named);
    std::set<std::string> parameters;
    if (named != subjects.end())
        for (const Parameter& parameter : named->parameters.parameters) parameters.insert(parameter.name);
    const auto is_mesh_key = [](const TomlEntry& entry) {
        return std::ranges::any_of(mesh_keys().keys(),
                                   [&](const auto& key) { return key.info.name == entry.key; });
    };
    for (const TomlEntry& entry : section.entries) {
        if (is_mesh_key(entry)) continue;
        const TomlPlace here = place.at(entry.line);
        if (parameters.contains(entry.key)) {
            const Result<void> read = read_parameter(entry, *named->parameters.find(entry.key), mesh, here);
            if (!read) return read;
            continue;
        }
        const auto other = std::ranges::find_if(
            subjects, [&](const Subject& subject) { return subject.parameters.find(entry.key); });
        if (other != subjects.end())
            return here.error("mesh." + entry.key + ": only builtin:" + other->name + " has it, not " +
                              mesh_text + "; leave it out");
    }
    return read_section(section, "mesh", mesh_keys(), mesh, place, parameters);
}

// [name] once or [[name]] any number of times.
template <class Target, class Read>
Result<void> read_tables(const TomlNode& root, const std::string& name, std::vector<Target>& targets,
                         const TomlPlace& place, const Read& read_one) {
    const TomlNode* node = root.find(name);
    if (!node) return {};
    const std::span<const TomlNode> tables =
        node->kind == TomlKind::array ? std::span<const TomlNode>(node->items) : std::span(node, 1);
    for (const TomlNode& table : tables) {
        if (table.kind != TomlKind::table) return no_table(table, name, "[[" + name + "]]", place);
        Target& target = targets.emplace_back();
        target.line = table.line;
        if (const Result<void> read = read_one(table, target); !read) return read;
    }
    return {};
}

Result<void> read_materials(const TomlNode& root, SceneDescription& scene, const TomlPlace& place) {
    const TomlNode* table = root.find("material");
    if (!table) return {};
    if (table->kind != TomlKind::table) return no_table(*table, "material", "[material.NAME]", place);
    for (const TomlEntry& entry : table->entries) {
        const std::string path = "material." + entry.key;
        if (entry.value.kind != TomlKind::table) return no_table(entry.value, path, "[" + path + "]", place);
        MaterialDescription& material = scene.materials[entry.key];
        material.line = entry.line;
        Result<void> read = read_section(entry.value, path, material_keys(), material, place, {"maps"});
        if (read) read = read_table(entry.value, "maps", maps_keys(), material.maps, place, path + ".");
        if (!read) return read;
    }
    return {};
}

Result<void> read_settings(const TomlNode& root, SceneDescription& scene, const TomlPlace& place) {
    const TomlNode* table = root.find("settings");
    if (!table) return {};
    if (table->kind != TomlKind::table) return no_table(*table, "settings", "[settings]", place);
    for (const TomlEntry& entry : table->entries) {
        const auto text = setting_text(entry.value);
        if (!text)
            return place.at(entry.line)
                .error("settings." + entry.key + " = " + toml_text(entry.value) +
                       ": a setting is a number, true or false, a string, or three numbers");
        scene.settings[entry.key] = *text;
    }
    return {};
}

Result<void> read_root(const TomlNode& root, SceneDescription& scene, std::span<const Subject> subjects,
                       const TomlPlace& place) {
    Result<void> read =
        read_section(root, "", head_keys(), scene.head, place,
                     {"mesh", "maps", "material", "skin", "light", "environment", "camera", "settings"});
    if (read)
        read =
            read_tables(root, "mesh", scene.meshes, place, [&](const TomlNode& table, MeshDescription& mesh) {
                return read_mesh_section(table, subjects, mesh, place);
            });
    if (read) read = read_table(root, "maps", maps_keys(), scene.maps, place);
    if (read) read = read_materials(root, scene, place);
    if (read) read = read_table(root, "skin", skin_keys(), scene.skin, place);
    if (read)
        read = read_tables(root, "light", scene.lights, place,
                           [&](const TomlNode& table, LightDescription& light) {
                               return read_section(table, "light", light_keys(), light, place);
                           });
    if (read && root.find("environment"))
        read = read_table(root, "environment", environment_keys(), scene.environment.emplace(), place);
    if (read) read = read_table(root, "camera", camera_keys(), scene.camera, place);
    if (read) read = read_settings(root, scene, place);
    return read;
}

}  // namespace

Result<SceneDescription> parse_scene(std::string_view text, const std::filesystem::path& file,
                                     std::span<const Subject> subjects) {
    const TomlPlace place{file.string()};
    if (text.size() > kMaxSceneBytes) return place.error("larger than 1 MB, so no scene file");
    const Result<TomlNode> root = parse_toml(text, place.file);
    if (!root) return root.error();
    SceneDescription scene{.file = file};
    if (const Result<void> read = read_root(*root, scene, subjects, place); !read) return read.error();
    if (const Result<void> checked = check_scene(scene); !checked) return checked.error();
    return scene;
}

}  // namespace dermis
