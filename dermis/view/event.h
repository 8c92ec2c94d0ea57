#pragma once
// Input events, from the window or from a script: both are handled alike.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/base/vec.h"

namespace dermis::view {

struct Modifiers {
    bool shift = false, ctrl = false, alt = false;
    friend bool operator==(const Modifiers&, const Modifiers&) = default;
};

/// Letters, digits and punctuation are their upper-case ASCII code; the others have GLFW's numbers.
struct Key {
    int code = 0;
    friend bool operator==(const Key&, const Key&) = default;
};
inline constexpr Key kKeySpace{32}, kKeyEscape{256}, kKeyEnter{257}, kKeyTab{258}, kKeyBackspace{259},
    kKeyInsert{260}, kKeyDelete{261}, kKeyRight{262}, kKeyLeft{263}, kKeyDown{264}, kKeyUp{265},
    kKeyPageUp{266}, kKeyPageDown{267}, kKeyHome{268}, kKeyEnd{269}, kKeyF1{290}, kKeyF12{301};

/// A key with what is held beside it: "ctrl+shift+C", "F1", "left".
struct KeyChord {
    Key key;
    Modifiers modifiers;
    friend bool operator==(const KeyChord&, const KeyChord&) = default;
};
[[nodiscard]] Result<KeyChord> parse_key_chord(std::string_view text);
[[nodiscard]] std::string key_chord_text(const KeyChord& chord);

enum class MouseButton { left, right, middle };
enum class EventKind { mouse_move, mouse_button, scroll, key, text, drop };

/// Only the members of its kind mean anything. Positions are pixels of the framebuffer from the top left.
struct Event {
    EventKind kind = EventKind::mouse_move;
    Vec2 position_px = {};
    MouseButton button = MouseButton::left;
    bool pressed = false;  ///< mouse_button, key
    float scroll = 0;      ///< notches, away from the user is positive
    Key key = {};
    Modifiers modifiers = {};
    char32_t character = 0;
    std::vector<std::filesystem::path> paths = {};
};

}  // namespace dermis::view
