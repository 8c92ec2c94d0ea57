// Debian 12's toml++ 3.3.0 fails on some malformed files: it asserts on some headers ("[ ="), has undefined
// behaviour there when NDEBUG is set, and reaches a branch declared unreachable when a letter like U+00E9 is
// outside of quotes. So this file is compiled without NDEBUG, assertions throw, and bytes beyond ASCII are
// escaped before parsing (see escape_bytes).

#include "dermis/scene/toml_document.h"

#include <algorithm>
#include <charconv>

namespace {

struct TomlAssertion {};

[[noreturn]] void throw_toml_assertion() {
    throw TomlAssertion{};
}

}  // namespace

#define TOML_ASSERT(expr) ((expr) ? void(0) : throw_toml_assertion())
#include <toml++/toml.h>

namespace dermis::inline scene {
namespace {

constexpr char kEscape = '~';

// "~" and two hexadecimal digits for every byte beyond ASCII and for "~" itself. TOML allows "~" in strings
// and comments only, as it does the bytes that it replaces.
std::string escape_bytes(std::string_view text) {
    constexpr char kDigits[] = "0123456789abcdef";
    std::string escaped;
    escaped.reserve(text.size());
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80 && c != kEscape)
            escaped += c;
        else
            escaped += {kEscape, kDigits[byte >> 4], kDigits[byte & 15]};
    }
    return escaped;
}

std::string unescape_bytes(std::string_view text) {
    std::string plain;
    for (size_t i = 0; i < text.size(); ++i) {
        unsigned byte = 0;
        if (text[i] == kEscape && i + 2 < text.size() &&
            std::from_chars(&text[i + 1], &text[i + 3], byte, 16).ptr == &text[i + 3])
            plain += char(byte), i += 2;
        else
            plain += text[i];
    }
    return plain;
}

// Length of the UTF-8 sequence at the front (RFC 3629: shortest form, no surrogates, up to U+10FFFF); 0 when
// it is none.
size_t utf8_length(std::string_view text) {
    const auto byte = [&](size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    const unsigned first = byte(0);
    const size_t length = first < 0x80   ? 1
                          : first < 0xC2 ? 0
                          : first < 0xE0 ? 2
                          : first < 0xF0 ? 3
                          : first < 0xF5 ? 4
                                         : 0;
    for (size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xC0) != 0x80) return 0;
    const bool overlong = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xF0 && byte(1) < 0x90);
    const bool outside = (first == 0xED && byte(1) >= 0xA0) || (first == 0xF4 && byte(1) >= 0x90);
    return overlong || outside ? 0 : length;
}

int line_of(std::string_view text, size_t at) {
    return int(std::ranges::count(text.substr(0, at), '\n')) + 1;
}

// 0 when there is none.
int invalid_utf8_line(std::string_view text) {
    for (size_t at = 0; at < text.size();) {
        const size_t length = utf8_length(text.substr(at));
        if (length == 0) return line_of(text, at);
        at += length;
    }
    return 0;
}

// toml++ follows a dotted key by recursion, without a limit. 0 when no line nests that deep.
int too_deep_line(std::string_view text) {
    constexpr int kMostDots = 1000;
    int line = 1, dots = 0;
    for (const char c : text) {
        if (c == '.' && ++dots > kMostDots) return line;
        if (c == '\n') ++line;
        if (c == '\n' || c == ',' || c == '=' || c == '[' || c == '{') dots = 0;
    }
    return 0;
}

bool asserts(std::string_view text) {
    try {
        (void)toml::parse(text);
    } catch (const TomlAssertion&) {
        return true;
    } catch (const toml::parse_error&) {
    }
    return false;
}

// An assertion does not state its line. The parser reads from the front, so that exactly the prefixes that
// contain the line assert.
int asserting_line(std::string_view text) {
    std::vector<size_t> ends;
    for (size_t i = 0; i < text.size(); ++i)
        if (text[i] == '\n') ends.push_back(i);
    ends.push_back(text.size());
    const auto found =
        std::ranges::partition_point(ends, [&](size_t end) { return !asserts(text.substr(0, end)); });
    return int(found - ends.begin()) + 1;
}

TomlNode convert(const toml::node& node);

void convert_entries(const toml::table& table, TomlNode& node) {
    for (const auto& [key, value] : table)
        node.entries.push_back({unescape_bytes(key.str()), int(key.source().begin.line), convert(value)});
    std::ranges::stable_sort(node.entries, {}, &TomlEntry::line);
}

TomlNode convert(const toml::node& node) {
    TomlNode result{.kind = TomlKind::date, .line = int(node.source().begin.line)};
    if (const toml::table* table = node.as_table()) {
        result.kind = TomlKind::table;
        convert_entries(*table, result);
    } else if (const toml::array* array = node.as_array()) {
        result.kind = TomlKind::array;
        for (const toml::node& item : *array) result.items.push_back(convert(item));
    } else if (const auto text = node.value_exact<std::string>()) {
        result.kind = TomlKind::string;
        result.text = unescape_bytes(*text);
    } else if (const auto integer = node.value_exact<int64_t>()) {
        result.kind = TomlKind::integer;
        result.integer = *integer;
        result.number = double(*integer);
    } else if (const auto number = node.value_exact<double>()) {
        result.kind = TomlKind::number;
        result.number = *number;
    } else if (const auto flag = node.value_exact<bool>()) {
        result.kind = TomlKind::boolean;
        result.flag = *flag;
    }
    return result;
}

}  // namespace

const TomlNode* TomlNode::find(std::string_view key) const {
    const auto found = std::ranges::find(entries, key, &TomlEntry::key);
    return found == entries.end() ? nullptr : &found->value;
}

Error TomlPlace::error(std::string message) const {
    std::ranges::replace_if(
        message, [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
    return Error{file.empty() ? std::move(message)
                              : file + ":" + std::to_string(line) + ": " + std::move(message)};
}

Result<TomlNode> parse_toml(std::string_view text, const std::string& file) {
    const TomlPlace place{file};
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // a byte order mark
    if (const int line = invalid_utf8_line(text))
        return place.at(line).error("not TOML: bytes that are not UTF-8");
    if (const int line = too_deep_line(text)) return place.at(line).error("nested deeper than 1000 levels");
    const std::string escaped = escape_bytes(text);
    try {
        return convert(toml::parse(escaped));
    } catch (const toml::parse_error& wrong) {
        return place.at(int(wrong.source().begin.line))
            .error("not TOML: " + unescape_bytes(wrong.description()) +
                   (wrong.description().ends_with("expected decimal digit, saw '.'") ? "; write 0.5, not .5"
                                                                                     : ""));
    } catch (const TomlAssertion&) {
        return place.at(asserting_line(escaped)).error("not TOML: a name in brackets or a key is malformed");
    }
}

}  // namespace dermis::inline scene
