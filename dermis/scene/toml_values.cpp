#include "dermis/scene/toml_values.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "dermis/base/text.h"

namespace dermis::inline scene {
namespace {

std::string range_text(const KeyInfo& info) {
    return "from " + to_text(info.min) + " to " + to_text(info.max) +
           (info.unit.empty() ? "" : " (" + info.unit + ")");
}

std::string quoted_choices(const KeyInfo& info) {
    std::vector<std::string> quoted;
    for (const std::string& choice : info.choices) quoted.push_back('"' + choice + '"');
    return join(quoted, ", ");
}

bool read_number(const TomlNode& node, const KeyInfo& info, double& value) {
    value = node.number;
    return node.is_number() && value >= info.min && value <= info.max;
}

bool read_vector(const TomlNode& node, const KeyInfo& info, KeyValue& value) {
    if (node.kind != TomlKind::array || node.items.size() != 3) return false;
    for (size_t i = 0; i < 3; ++i)
        if (!read_number(node.items[i], info, value.numbers[i])) return false;
    return true;
}

bool read_choice(const TomlNode& node, const KeyInfo& info, KeyValue& value) {
    const auto found = std::ranges::find(info.choices, node.text);
    value.integer = int(found - info.choices.begin());
    return node.kind == TomlKind::string && found != info.choices.end();
}

}  // namespace

std::string toml_kind(const TomlNode& node) {
    switch (node.kind) {
        case TomlKind::table:
            return "a table";
        case TomlKind::array:
            return "an array";
        case TomlKind::string:
            return "a string";
        case TomlKind::integer:
            return "an integer";
        case TomlKind::number:
            return "a number";
        case TomlKind::boolean:
            return "true or false";
        case TomlKind::date:
            break;
    }
    return "a date or time";
}

std::string toml_string(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result + "\"";
}

std::string toml_key(std::string_view name) {
    const bool is_bare = !name.empty() && std::ranges::all_of(name, [](unsigned char c) {
        return (c < 128 && std::isalnum(c) != 0) || c == '_' || c == '-';
    });
    return is_bare ? std::string(name) : toml_string(name);
}

std::string toml_text(const TomlNode& node) {
    constexpr size_t kShort = 40;
    switch (node.kind) {
        case TomlKind::string:
            return node.text.size() <= kShort ? '"' + node.text + '"' : "a string";
        case TomlKind::integer:
            return std::to_string(node.integer);
        case TomlKind::number:
            return to_text(node.number);
        case TomlKind::boolean:
            return node.flag ? "true" : "false";
        default:
            return toml_kind(node);
    }
}

std::string wanted_text(const KeyInfo& info) {
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

bool read_toml_value(const TomlNode& node, const KeyInfo& info, KeyValue& value) {
    switch (info.kind) {
        case KeyKind::number:
            return read_number(node, info, value.numbers[0]);
        case KeyKind::integer:
            if (node.kind != TomlKind::integer || !read_number(node, info, value.numbers[0])) return false;
            value.integer = int(node.integer);
            return true;
        case KeyKind::toggle:
            value.integer = node.flag;
            return node.kind == TomlKind::boolean;
        case KeyKind::text:
            value.text = node.text;
            return node.kind == TomlKind::string;
        case KeyKind::file:
            value.text = node.text;
            return node.kind == TomlKind::string && !node.text.empty();
        case KeyKind::choice:
            return read_choice(node, info, value);
        case KeyKind::vector:
        case KeyKind::color:
            return read_vector(node, info, value);
    }
    return false;
}

std::optional<std::string> setting_text(const TomlNode& node) {
    if (node.kind == TomlKind::string) return node.text;
    if (node.kind == TomlKind::boolean) return node.flag ? "on" : "off";
    if (node.is_number() && std::isfinite(node.number)) return to_text(node.number);
    if (node.kind != TomlKind::array || node.items.size() != 3) return std::nullopt;
    std::vector<std::string> parts;
    for (const TomlNode& item : node.items) {
        if (!item.is_number() || !std::isfinite(item.number)) return std::nullopt;
        parts.push_back(to_text(item.number));
    }
    return join(parts, ",");
}

Result<void> set_mesh_key(MeshDescription& mesh, const std::string& name, std::span<const Subject> subjects,
                          const TomlPlace& place,
                          const std::function<const TomlNode&(const KeyInfo&)>& node_of) {
    if (mesh_keys().find(name)) return set_key(mesh_keys(), mesh, "mesh", name, place, node_of);
    const auto has_it = [&](const Subject& subject) { return subject.parameters.find(name) != nullptr; };
    const auto is_named = [&](const Subject& subject) {
        return subject.name == subject_name(mesh.file.text);
    };
    const auto named = std::ranges::find_if(subjects, is_named);
    if (named == subjects.end() || !has_it(*named)) {
        const auto other = std::ranges::find_if(subjects, has_it);
        if (other != subjects.end())
            return place.error("mesh." + name + ": only builtin:" + other->name + " has it, not " +
                               mesh.file.text + "; leave it out");
        std::set<std::string> parameters;
        if (named != subjects.end())
            for (const Parameter& parameter : named->parameters.parameters) parameters.insert(parameter.name);
        return set_key(mesh_keys(), mesh, "mesh", name, place, node_of, parameters);
    }
    const KeyInfo info = key_info(*named->parameters.find(name));
    const TomlNode& node = node_of(info);
    if (KeyValue value; !read_toml_value(node, info, value))
        return place.error("mesh." + name + " = " + toml_text(node) + ": " + name + " " + wanted_text(info));
    mesh.parameters[name] = *setting_text(node);
    return {};
}

}  // namespace dermis::inline scene
