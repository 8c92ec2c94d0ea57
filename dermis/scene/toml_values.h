#pragma once
// TOML values as keys want them, and as errors repeat them.

#include <optional>
#include <set>
#include <string>

#include "dermis/base/text.h"
#include "dermis/scene/scene_keys.h"
#include "dermis/scene/toml_document.h"

namespace dermis::inline scene {

/// "a table", "an integer", ...
[[nodiscard]] std::string toml_kind(const TomlNode& node);

/// In double quotes, as TOML writes a string without line breaks.
[[nodiscard]] std::string toml_string(std::string_view text);

/// A key or a part of a header: in quotes where TOML needs them.
[[nodiscard]] std::string toml_key(std::string_view name);

/// The value as the file has it when it is short, else its kind.
[[nodiscard]] std::string toml_text(const TomlNode& node);

/// False when the value has the wrong type or is out of range.
[[nodiscard]] bool read_toml_value(const TomlNode& node, const KeyInfo& info, KeyValue& value);

/// "is a number from 0 to 1": what would be right.
[[nodiscard]] std::string wanted_text(const KeyInfo& info);

/// Settings belong to a technique, which knows their ranges; here they only become text. Nothing when the
/// value is of a kind that no setting has.
[[nodiscard]] std::optional<std::string> setting_text(const TomlNode& node);

/// Sets the key `name` of the section `path` ("" is the root) to the value that `node_of(const KeyInfo&)`
/// gives for it. Errors: no such key (with the sections that have it, or the one that may be meant, out of
/// the table and `nested`), a wrong type, out of range.
template <class Target, class NodeOf>
[[nodiscard]] Result<void> set_key(const KeyTable<Target>& table, Target& target, const std::string& path,
                                   const std::string& name, const TomlPlace& place, const NodeOf& node_of,
                                   const std::set<std::string>& nested = {}) {
    const Key<Target>* key = table.find(name);
    if (!key) {
        std::vector<std::string> names(nested.begin(), nested.end());
        for (const Key<Target>& known : table.keys()) names.push_back(known.info.name);
        const std::string what = path.empty() ? "key" : "key in [" + path + "]:";
        if (const std::string others = sections_with_key(name); !others.empty())
            return place.error("unknown " + what + " '" + name + "'; it is a key of " + others);
        return place.error(unknown_name(what, name, names));
    }
    const TomlNode& node = node_of(key->info);
    KeyValue value{.full_name = path.empty() ? name : path + "." + name,
                   .line = place.file.empty() ? 0 : place.line};
    if (!read_toml_value(node, key->info, value))
        return place.error(value.full_name + " = " + toml_text(node) + ": " + name + " " +
                           wanted_text(key->info));
    key->set(target, value);
    return {};
}

/// The same of a [[mesh]], whose file is set: also a parameter of the subject that it names. Errors:
/// likewise, and that only another subject has it.
[[nodiscard]] Result<void> set_mesh_key(MeshDescription& mesh, const std::string& name,
                                        std::span<const Subject> subjects, const TomlPlace& place,
                                        const std::function<const TomlNode&(const KeyInfo&)>& node_of);

}  // namespace dermis::inline scene
