// From TOML to a description: looks every key up in its section's table, checks and sets it.

#include <algorithm>
#include <set>

#include "dermis/base/text.h"
#include "dermis/scene/scene_checks.h"
#include "dermis/scene/scene_keys.h"
#include "dermis/scene/toml_document.h"
#include "dermis/scene/toml_values.h"

namespace dermis::inline scene {
namespace {

// Sets the keys of the section's table; `nested` are tables inside it that are read elsewhere.
template <class Target>
Result<void> read_section(const TomlNode& section, const std::string& path, const KeyTable<Target>& table,
                          Target& target, const TomlPlace& place, const std::set<std::string>& nested = {}) {
    for (const TomlEntry& entry : section.entries) {
        if (nested.contains(entry.key)) continue;
        const auto value = [&](const KeyInfo&) -> const TomlNode& { return entry.value; };
        const Result<void> set = set_key(table, target, path, entry.key, place.at(entry.line), value, nested);
        if (!set) return set;
    }
    return {};
}

Error no_table(const TomlNode& node, const std::string& path, const std::string& written,
               const TomlPlace& place) {
    return place.at(node.line).error(path + " is " + toml_kind(node) + ", not a table; write " + written);
}

template <class Target>
Result<void> read_table(const TomlNode& root, const std::string& name, const KeyTable<Target>& keys,
                        Target& target, const TomlPlace& place, const std::string& path_prefix = "",
                        const std::set<std::string>& nested = {}) {
    const TomlNode* table = root.find(name);
    if (!table) return {};
    const std::string path = path_prefix + name;
    if (table->kind != TomlKind::table) return no_table(*table, path, "[" + path + "]", place);
    if constexpr (requires { target.line; }) target.line = table->line;
    return read_section(*table, path, keys, target, place, nested);
}

// `file` first: it decides whose parameters the other keys are.
Result<void> read_mesh(const TomlNode& section, std::span<const Subject> subjects, MeshDescription& mesh,
                       const TomlPlace& place) {
    for (const bool own : {true, false})
        for (const TomlEntry& entry : section.entries) {
            if ((mesh_keys().find(entry.key) != nullptr) != own) continue;
            const auto value = [&](const KeyInfo&) -> const TomlNode& { return entry.value; };
            const Result<void> set = set_mesh_key(mesh, entry.key, subjects, place.at(entry.line), value);
            if (!set) return set;
        }
    return {};
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

// A table whose keys are the names of morph targets.
template <class KeyOf, class Take>
Result<void> read_targets(const TomlNode* table, const std::string& path, const KeyOf& key_of,
                          const TomlPlace& place, const Take& take) {
    if (!table) return {};
    if (table->kind != TomlKind::table) return no_table(*table, path, "[" + path + "]", place);
    for (const TomlEntry& entry : table->entries) {
        KeyValue value;
        const KeyInfo info = key_of(entry.key);
        if (!read_toml_value(entry.value, info, value))
            return place.at(entry.line)
                .error(path + "." + entry.key + " = " + toml_text(entry.value) + ": " + entry.key + " " +
                       wanted_text(info));
        value.line = entry.line;
        take(entry.key, value);
    }
    return {};
}

Result<void> read_skin(const TomlNode& root, SceneDescription& scene, const TomlPlace& place) {
    DERMIS_TRY(read_table(root, "skin", skin_keys(), scene.skin, place, "", {"blood_by_target"}));
    const TomlNode* skin = root.find("skin");
    if (!skin) return {};
    return read_targets(skin->find("blood_by_target"), kBloodByTarget, blood_map_key, place,
                        [&](const std::string& target, const KeyValue& value) {
                            scene.blood_by_target[target] = blood_map_of(target, value);
                        });
}

Result<void> read_root(const TomlNode& root, SceneDescription& scene, std::span<const Subject> subjects,
                       const TomlPlace& place) {
    Result<void> read = read_section(root, "", head_keys(), scene.head, place,
                                     {"mesh", "maps", "material", "skin", "animation", "morph", "light",
                                      "environment", "camera", "settings"});
    if (read)
        read =
            read_tables(root, "mesh", scene.meshes, place, [&](const TomlNode& table, MeshDescription& mesh) {
                return read_mesh(table, subjects, mesh, place);
            });
    if (read) read = read_table(root, "maps", maps_keys(), scene.maps, place);
    if (read) read = read_materials(root, scene, place);
    if (read) read = read_skin(root, scene, place);
    if (read) read = read_table(root, "animation", animation_keys(), scene.motion, place);
    if (read)
        read = read_targets(root.find("morph"), "morph", morph_key, place,
                            [&](const std::string& target, const KeyValue& value) {
                                scene.motion.morph[target] = float(value.numbers[0]);
                            });
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
    DERMIS_TRY_ASSIGN(const TomlNode root, parse_toml(text, place.file));
    SceneDescription scene{.file = file};
    DERMIS_TRY(read_root(root, scene, subjects, place));
    DERMIS_TRY(check_scene(scene));
    return scene;
}

}  // namespace dermis::inline scene
