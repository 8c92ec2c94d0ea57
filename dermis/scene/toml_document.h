#pragma once
// TOML as a plain tree that remembers its lines. toml++ stays behind it.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"

namespace dermis::inline scene {

enum class TomlKind { table, array, string, integer, number, boolean, date };

struct TomlEntry;

/// One value; which member holds it follows from `kind` (an integer is in `number` too; a date has none).
struct TomlNode {
    TomlKind kind = TomlKind::table;
    int line = 1;
    std::string text;
    double number = 0;
    int64_t integer = 0;
    bool flag = false;
    std::vector<TomlNode> items;
    std::vector<TomlEntry> entries;  ///< in the order of the file

    [[nodiscard]] const TomlNode* find(std::string_view key) const;
    [[nodiscard]] bool is_number() const { return kind == TomlKind::number || kind == TomlKind::integer; }
};

struct TomlEntry {
    std::string key;
    int line = 1;
    TomlNode value;
};

struct TomlPlace {
    std::string file;
    int line = 1;

    /// "FILE:LINE: message", without a file only the message; in one line whatever the message quotes.
    [[nodiscard]] Error error(std::string message) const;
    [[nodiscard]] TomlPlace at(int other_line) const { return {file, other_line}; }
};

/// The root table. Errors: "FILE:LINE: not TOML: ...", also for bytes that are not UTF-8.
[[nodiscard]] Result<TomlNode> parse_toml(std::string_view text, const std::string& file);

}  // namespace dermis::inline scene
