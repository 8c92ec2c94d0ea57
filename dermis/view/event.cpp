#include "dermis/view/event.h"

#include <algorithm>

#include "dermis/base/text.h"

namespace dermis::view {
namespace {

struct NamedKey {
    std::string_view name;
    Key key;
};
constexpr NamedKey kNamedKeys[] = {
    {"space", kKeySpace},   {"escape", kKeyEscape}, {"enter", kKeyEnter},        {"tab", kKeyTab},
    {"insert", kKeyInsert}, {"delete", kKeyDelete}, {"right", kKeyRight},        {"left", kKeyLeft},
    {"down", kKeyDown},     {"up", kKeyUp},         {"pageup", kKeyPageUp},      {"pagedown", kKeyPageDown},
    {"home", kKeyHome},     {"end", kKeyEnd},       {"backspace", kKeyBackspace}};

bool is_function_key(Key key) {
    return key.code >= kKeyF1.code && key.code <= kKeyF12.code;
}

Result<Key> parse_key(std::string_view text) {
    if (text.size() == 1 && text[0] > ' ' && text[0] < 127) {
        const char c = text[0];
        return Key{c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c};
    }
    const std::string lower = to_lower(text);
    std::vector<std::string> names;
    for (const NamedKey& named : kNamedKeys) {
        if (named.name == lower) return named.key;
        names.emplace_back(named.name);
    }
    if (lower.starts_with('f')) {
        const auto number = parse_number(std::string_view(lower).substr(1));
        if (number && *number >= 1 && *number <= 12 && *number == int(*number))
            return Key{kKeyF1.code + int(*number) - 1};
    }
    names.emplace_back("F1 to F12");
    return Error{unknown_name("key", text, names)};
}

}  // namespace

Result<KeyChord> parse_key_chord(std::string_view text) {
    KeyChord chord;
    std::vector<std::string_view> parts = split(text, '+');
    if (text.ends_with("++") || text == "+") {  // the plus key itself
        parts.pop_back();
        parts.back() = "+";
    }
    for (size_t i = 0; i + 1 < parts.size(); ++i) {
        const std::string name = to_lower(parts[i]);
        const std::vector<std::string> names = {"ctrl", "shift", "alt"};
        if (name == "ctrl")
            chord.modifiers.ctrl = true;
        else if (name == "shift")
            chord.modifiers.shift = true;
        else if (name == "alt")
            chord.modifiers.alt = true;
        else
            return Error{unknown_name("modifier", parts[i], names)};
    }
    const Result<Key> key = parse_key(parts.back());
    if (!key) return key.error();
    chord.key = *key;
    return chord;
}

std::string key_chord_text(const KeyChord& chord) {
    std::string text;
    if (chord.modifiers.ctrl) text += "ctrl+";
    if (chord.modifiers.shift) text += "shift+";
    if (chord.modifiers.alt) text += "alt+";
    if (is_function_key(chord.key)) return text + "F" + std::to_string(chord.key.code - kKeyF1.code + 1);
    const auto named = std::ranges::find(kNamedKeys, chord.key, &NamedKey::key);
    if (named != std::end(kNamedKeys)) return text + std::string(named->name);
    return text + char(chord.key.code);
}

}  // namespace dermis::view
