#include "dermis/base/text.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace dermis::inline base {
namespace {

template <class Number>
std::string shortest_text(Number value) {
    char buffer[64];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value);
    return std::string(buffer, end.ptr);
}

// Bytes of the UTF-8 character at the front; 0 when there is none.
size_t character_length(std::string_view text) {
    const auto byte = [&](size_t i) { return i < text.size() ? uint8_t(text[i]) : uint8_t{0}; };
    const size_t length = byte(0) < 0x80                      ? 1
                          : byte(0) >= 0xc2 && byte(0) < 0xe0 ? 2
                          : byte(0) >= 0xe0 && byte(0) < 0xf0 ? 3
                          : byte(0) >= 0xf0 && byte(0) < 0xf5 ? 4
                                                              : 0;
    for (size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xc0) != 0x80) return 0;
    return length;
}

// C0, DEL, C1 (U+0080 to U+009F), whose U+009B starts an escape sequence too, and what overrides the
// direction of writing (U+202A to U+202E, U+2066 to U+2069), so that a name reads as another.
bool is_control(std::string_view character) {
    const auto first = uint8_t(character[0]);
    if (character.size() == 1) return first < 0x20 || first == 0x7f;
    if (first == 0xc2) return uint8_t(character[1]) < 0xa0;
    return (character >= "\u202a" && character <= "\u202e") ||
           (character >= "\u2066" && character <= "\u2069");
}

// Levenshtein distance, one row at a time.
size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<size_t> before, last, row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 1; i <= a.size(); ++i) {
        before = std::exchange(last, row);
        row[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
    }
    return row.back();
}

}  // namespace

std::string to_text(double value) {
    return shortest_text(value);
}
std::string to_text(float value) {
    return shortest_text(value);
}

std::optional<double> parse_number(std::string_view text) {
    text = trim(text);
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc{} || result.ptr != text.data() + text.size()) return std::nullopt;
    return value;
}

std::string_view trim(std::string_view text) {
    const auto is_space = [](unsigned char c) { return std::isspace(c) != 0; };
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (size_t at = 0;;) {
        const size_t next = text.find(separator, at);
        parts.push_back(text.substr(at, next - at));
        if (next == std::string_view::npos) return parts;
        at = next + 1;
    }
}

std::string join(std::span<const std::string> parts, std::string_view separator) {
    std::string joined;
    for (const std::string& part : parts) {
        if (&part != &parts.front()) joined += separator;
        joined += part;
    }
    return joined;
}

std::string to_lower(std::string_view text) {
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return lower;
}

std::string as_markup(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

std::string_view without_byte_order_mark(std::string_view text) {
    return text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text;
}

std::vector<std::string> each_once(std::span<const std::string> texts) {
    std::vector<std::string> once;
    std::unordered_map<std::string, size_t> count;
    for (const std::string& text : texts)
        if (++count[text] == 1) once.push_back(text);
    for (std::string& text : once)
        if (const size_t times = count[text]; times > 1) text += " (" + std::to_string(times) + " times)";
    return once;
}

std::string printable_line(std::string_view text, size_t max_bytes) {
    std::string line;
    while (!text.empty()) {
        const size_t length = character_length(text);
        const std::string_view character = text.substr(0, std::max<size_t>(length, 1));
        if (line.size() + character.size() > max_bytes) return line + "...";
        if (length == 0 || is_control(character))
            line += '?';
        else
            line += character;
        text.remove_prefix(character.size());
    }
    return line;
}

std::optional<std::string> closest_name(std::string_view wrong, std::span<const std::string> names) {
    std::optional<std::string> best;
    size_t best_distance = std::max<size_t>(1, wrong.size() / 3) + 1;
    for (const std::string& name : names) {
        // Leaving the unit off ("exposure" for "exposure_ev") is one mistake, however long the unit is.
        const std::string word = to_lower(wrong), candidate = to_lower(name);
        const size_t distance =
            !word.empty() && candidate.starts_with(word + '_') ? 1 : edit_distance(word, candidate);
        if (distance < best_distance) best_distance = distance, best = name;
    }
    return best;
}

std::string unknown_name(std::string_view what, std::string_view wrong, std::span<const std::string> names) {
    std::string message = "unknown " + std::string(what) + " '" + std::string(wrong) + "'";
    const auto meant = closest_name(wrong, names);
    return message + (meant ? "; did you mean '" + *meant + "'? known: " : "; known: ") + join(names, ", ");
}

}  // namespace dermis::inline base
