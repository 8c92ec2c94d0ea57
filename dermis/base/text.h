#pragma once
// Text for users and files: numbers that round-trip in every locale, suggestions for misspelt names.

#include <charconv>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dermis::inline base {

/// Shortest text that reads back as the same number ("0.1", not "0.100000001"); "nan", "inf" as in C++.
[[nodiscard]] std::string to_text(double value);
[[nodiscard]] std::string to_text(float value);

/// The whole text as a number; nothing if it is empty or anything is left over. Accepts a leading '+'.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

[[nodiscard]] std::string_view trim(std::string_view text);
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);
[[nodiscard]] std::string join(std::span<const std::string> parts, std::string_view separator);
[[nodiscard]] std::string to_lower(std::string_view text);

/// Editors of some systems begin a text file with a byte order mark.
[[nodiscard]] std::string_view without_byte_order_mark(std::string_view text);

/// For text and quoted attributes of HTML and SVG: & < > " as entities.
[[nodiscard]] std::string as_markup(std::string_view text);

/// Each text once, in order of first appearance, with " (N times)" if repeated.
[[nodiscard]] std::vector<std::string> each_once(std::span<const std::string> texts);

/// Any text as one line for a terminal: control characters (line breaks, escape sequences, changes of writing
/// direction) and bytes that are not UTF-8 become '?'; text beyond `max_bytes` becomes "...".
[[nodiscard]] std::string printable_line(std::string_view text, size_t max_bytes = 1000);

/// The candidate that was most likely meant, if any: edit distance at most a third of the word, or the word
/// plus a unit after an underscore.
[[nodiscard]] std::optional<std::string> closest_name(std::string_view wrong,
                                                      std::span<const std::string> names);

/// "unknown WHAT 'wrong'; did you mean 'right'? known: a, b, c"
[[nodiscard]] std::string unknown_name(std::string_view what, std::string_view wrong,
                                       std::span<const std::string> names);

}  // namespace dermis::inline base
