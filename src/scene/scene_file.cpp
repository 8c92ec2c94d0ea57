// TOML to a description: walk the parsed tree, look every key up in its section's table, check, set.

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <set>

#include "dermis/base/text.h"
#include "dermis/scene/scene_checks.h"
#include "dermis/scene/scene_keys.h"

namespace dermis {
namespace {

struct Place {
    std::string file;
    int line = 0;

    [[nodiscard]] Error error(std::string message) const {
        // Keys and values are quoted as they are, and may hold line breaks.
        std::ranges::replace_if(
            message, [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
        return Error{file + ":" + std::to_string(line) + ": " + std::move(message)};
    }
    [[nodiscard]] Place at(const toml::source_region& source) const { return {file, int(source.begin.line)}; }
};

std::string_view kind_name(const toml::node& node) {
    switch (node.type()) {
        case toml::node_type::table:
            return "a table";
        case toml::node_type::array:
            return "an array";
        case toml::node_type::string:
            return "a string";
        case toml::node_type::integer:
            return "an integer";
        case toml::node_type::floating_point:
            return "a number";
        case toml::node_type::boolean:
            return "true or false";
        default:
            return "a date or time";
    }
}

std::string range_text(const KeyInfo& info) {
    return "from " + to_text(info.min) + " to " + to_text(info.max) +
           (info.unit.empty() ? "" : " (" + info.unit + ")");
}

std::string quoted_choices(const KeyInfo& info) {
    std::vector<std::string> quoted;
    for (const std::string& choice : info.choices) quoted.push_back('"' + choice + '"');
    return join(quoted, ", ");
}

// "is a number from 0 to 1": what every error about a value ends with.
std::string wanted(const KeyInfo& info) {
    switch (info.kind) {
        case KeyKind::number:
            return "is a number " + range_text(info);
        case KeyKind::integer:
            return "is an integer " + range_text(info);
        case KeyKind::toggle:
            return "is true or false";
        case KeyKind::text:
            return "is a string";
        case KeyKind::file:
            return "is a path in a string";
        case KeyKind::choice:
            return "is one of " + quoted_choices(info);
        case KeyKind::vector:
        case KeyKind::color:
            break;
    }
    return "is three numbers [x, y, z], each " + range_text(info);
}

bool read_number(const toml::node& node, const KeyInfo& info, double& value) {
    const auto number = node.value<double>();
    if (!number || node.is_boolean() || !(*number >= info.min && *number <= info.max)) return false;
    value = *number;
    return true;
}

bool read_vector(const toml::node& node, const KeyInfo& info, KeyValue& value) {
    const toml::array* array = node.as_array();
    if (!array || array->size() != 3) return false;
    for (size_t i = 0; i < 3; ++i)
        if (!read_number(*array->get(i), info, value.numbers[i])) return false;
    return true;
}

bool read_choice(const toml::node& node, const KeyInfo& info, KeyValue& value) {
    const auto found = std::ranges::find(info.choices, node.value_or(std::string()));
    value.integer = int(found - info.choices.begin());
    return found != info.choices.end();
}

bool read_value(const toml::node& node, const KeyInfo& info, KeyValue& value) {
    switch (info.kind) {
        case KeyKind::number:
            return read_number(node, info, value.numbers[0]);
        case KeyKind::integer:
            if (!node.is_integer() || !read_number(node, info, value.numbers[0])) return false;
            value.integer = int(value.numbers[0]);
            return true;
        case KeyKind::toggle:
            value.integer = node.value_or(false);
            return node.is_boolean();
        case KeyKind::text:
        case KeyKind::file:
            value.text = node.value_or(std::string());
            return node.is_string() && (info.kind == KeyKind::text || !value.text.empty());
        case KeyKind::choice:
            return read_choice(node, info, value);
        case KeyKind::vector:
        case KeyKind::color:
            return read_vector(node, info, value);
    }
    return false;
}

// The value as the file has it, when it is short enough to repeat.
std::string value_text(const toml::node& node) {
    if (node.is_table() || node.is_array()) return std::string(kind_name(node));
    if (const auto text = node.value_exact<std::string>())
        return text->size() <= 40 && std::ranges::all_of(*text, [](unsigned char c) { return c >= ' '; })
                   ? '"' + *text + '"'
                   : "a string";
    if (const auto integer = node.value_exact<int64_t>()) return std::to_string(*integer);
    if (const auto number = node.value_exact<double>()) return to_text(*number);
    if (const auto flag = node.value_exact<bool>()) return *flag ? "true" : "false";
    return std::string(kind_name(node));
}

// Sets what the section's table knows; `nested` are tables inside it that somebody else reads.
template <class Target>
Result<void> read_section(const toml::table& section, const std::string& path, const KeyTable<Target>& table,
                          Target& target, const Place& place, const std::set<std::string>& nested = {}) {
    std::vector<std::string> names(nested.begin(), nested.end());
    for (const Key<Target>& key : table.keys()) names.push_back(key.info.name);
    for (const auto& [toml_key, node] : section) {
        const std::string name(toml_key.str());
        if (nested.contains(name)) continue;
        const auto key =
            std::ranges::find_if(table.keys(), [&](const Key<Target>& k) { return k.info.name == name; });
        const Place here = place.at(toml_key.source());
        if (key == table.keys().end())
            return here.error(unknown_name(path.empty() ? "key" : "key in [" + path + "]:", name, names));
        KeyValue value{.full_name = path.empty() ? name : path + "." + name, .line = here.line};
        if (!read_value(node, key->info, value))
            return here.error(value.full_name + " = " + value_text(node) + ": " + name + " " +
                              wanted(key->info));
        key->set(target, value);
    }
    return {};
}

// [name] once or [[name]] any number of times.
Result<std::vector<const toml::table*>> tables_of(const toml::table& root, const char* name,
                                                  const Place& place) {
    std::vector<const toml::table*> tables;
    const toml::node* node = root.get(name);
    if (!node) return tables;
    const auto wrong = [&](const toml::node& what) {
        return place.at(what.source())
            .error(std::string(name) + " is " + std::string(kind_name(what)) + ", not a table; write [[" +
                   name + "]]");
    };
    if (const toml::table* table = node->as_table()) return std::vector{table};
    const toml::array* array = node->as_array();
    if (!array) return wrong(*node);
    for (const toml::node& element : *array) {
        if (!element.is_table()) return wrong(element);
        tables.push_back(element.as_table());
    }
    return tables;
}

Result<const toml::table*> table_of(const toml::table& root, const char* name, const std::string& path,
                                    const Place& place) {
    const toml::node* node = root.get(name);
    if (!node) return static_cast<const toml::table*>(nullptr);
    if (const toml::table* table = node->as_table()) return table;
    return place.at(node->source())
        .error(path + " is " + std::string(kind_name(*node)) + ", not a table; write [" + path + "]");
}

template <class Target>
Result<void> read_table(const toml::table& root, const char* name, const KeyTable<Target>& keys,
                        Target& target, const Place& place, const std::string& path_prefix = "") {
    const std::string path = path_prefix + name;
    const Result<const toml::table*> table = table_of(root, name, path, place);
    if (!table) return table.error();
    if (!*table) return {};
    if constexpr (requires { target.line; }) target.line = int((*table)->source().begin.line);
    return read_section(**table, path, keys, target, place);
}

template <class Target>
Result<void> read_tables(const toml::table& root, const char* name, const KeyTable<Target>& keys,
                         std::vector<Target>& targets, const Place& place) {
    const Result<std::vector<const toml::table*>> tables = tables_of(root, name, place);
    if (!tables) return tables.error();
    for (const toml::table* table : *tables) {
        Target target;
        target.line = int(table->source().begin.line);
        if (const Result<void> read = read_section(*table, name, keys, target, place); !read) return read;
        targets.push_back(std::move(target));
    }
    return {};
}

Result<void> read_materials(const toml::table& root, SceneDescription& scene, const Place& place) {
    const Result<const toml::table*> table = table_of(root, "material", "material.NAME", place);
    if (!table) return table.error();
    if (!*table) return {};
    for (const auto& [toml_key, node] : **table) {
        const std::string path = "material." + std::string(toml_key.str());
        const toml::table* section = node.as_table();
        if (!section)
            return place.at(toml_key.source())
                .error(path + " is " + std::string(kind_name(node)) + ", not a table; write [" + path + "]");
        MaterialDescription material;
        material.line = int(toml_key.source().begin.line);
        Result<void> read = read_section(*section, path, material_keys(), material, place, {"maps"});
        if (read) read = read_table(*section, "maps", maps_keys(), material.maps, place, path + ".");
        if (!read) return read;
        scene.materials.emplace(toml_key.str(), std::move(material));
    }
    return {};
}

// Settings belong to a technique, which knows their ranges; here they only become text.
std::optional<std::string> setting_text(const toml::node& node) {
    if (const auto text = node.value_exact<std::string>()) return *text;
    if (const auto flag = node.value_exact<bool>()) return *flag ? "on" : "off";
    if (const auto number = node.value<double>(); number && std::isfinite(*number)) return to_text(*number);
    const toml::array* array = node.as_array();
    if (!array || array->size() != 3) return std::nullopt;
    std::vector<std::string> parts;
    for (const toml::node& element : *array) {
        const auto number = element.value<double>();
        if (!number || element.is_boolean() || !std::isfinite(*number)) return std::nullopt;
        parts.push_back(to_text(*number));
    }
    return join(parts, ",");
}

Result<void> read_settings(const toml::table& root, SceneDescription& scene, const Place& place) {
    const Result<const toml::table*> table = table_of(root, "settings", "settings", place);
    if (!table) return table.error();
    if (!*table) return {};
    for (const auto& [toml_key, node] : **table) {
        const std::string name(toml_key.str());
        const auto text = setting_text(node);
        if (!text)
            return place.at(toml_key.source())
                .error("settings." + name + " = " + value_text(node) +
                       ": a setting is a number, true or false, a string, or three numbers");
        scene.settings[name] = *text;
    }
    return {};
}

Result<void> read_root(const toml::table& root, SceneDescription& scene, const Place& place) {
    Result<void> read =
        read_section(root, "", head_keys(), scene.head, place,
                     {"mesh", "maps", "material", "skin", "light", "environment", "camera", "settings"});
    if (read) read = read_tables(root, "mesh", mesh_keys(), scene.meshes, place);
    if (read) read = read_table(root, "maps", maps_keys(), scene.maps, place);
    if (read) read = read_materials(root, scene, place);
    if (read) read = read_table(root, "skin", skin_keys(), scene.skin, place);
    if (read) read = read_tables(root, "light", light_keys(), scene.lights, place);
    if (read && root.contains("environment"))
        read = read_table(root, "environment", environment_keys(), scene.environment.emplace(), place);
    if (read) read = read_table(root, "camera", camera_keys(), scene.camera, place);
    if (read) read = read_settings(root, scene, place);
    return read;
}

}  // namespace

Result<SceneDescription> parse_scene(std::string_view text, const std::filesystem::path& file) {
    Place place{file.string()};
    if (text.size() > kMaxSceneBytes) return Error{place.file + ": larger than 1 MB, so no scene file"};
    const toml::parse_result parsed = toml::parse(text, place.file);
    if (!parsed) {
        return place.at(parsed.error().source())
            .error("not TOML: " + std::string(parsed.error().description()));
    }
    SceneDescription scene{.file = file};
    if (const Result<void> read = read_root(parsed.table(), scene, place); !read) return read.error();
    if (const Result<void> checked = check_scene(scene); !checked) return checked.error();
    return scene;
}

}  // namespace dermis
