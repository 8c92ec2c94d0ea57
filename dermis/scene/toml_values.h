#pragma once
// TOML values as keys want them, and as errors repeat them.

#include <optional>
#include <string>

#include "dermis/scene/scene_keys.h"
#include "dermis/scene/toml_document.h"

namespace dermis {

/// "a table", "an integer", ...
[[nodiscard]] std::string toml_kind(const TomlNode& node);

/// The value as the file has it when it is short, else its kind.
[[nodiscard]] std::string toml_text(const TomlNode& node);

/// False when the value has the wrong type or is out of range.
[[nodiscard]] bool read_toml_value(const TomlNode& node, const KeyInfo& info, KeyValue& value);

/// "is a number from 0 to 1": what would be right.
[[nodiscard]] std::string wanted_text(const KeyInfo& info);

/// Settings belong to a technique, which knows their ranges; here they only become text. Nothing when the
/// value is of a kind that no setting has.
[[nodiscard]] std::optional<std::string> setting_text(const TomlNode& node);

}  // namespace dermis
