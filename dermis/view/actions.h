#pragma once
// The actions of keys in one table, for keyboard, help page and scripts.

#include <optional>
#include <span>
#include <string_view>

#include "dermis/view/event.h"

namespace dermis::view {

enum class Action {
    none,
    help,
    panels,
    fit,
    next_technique,
    last_technique,
    next_view,
    last_view,
    final_view,
    reset_parameters,
    brighter,
    darker,
    compare,
    swap_sides,
    reference,
    play,
    open,
    undo,
    redo,
    copy_view,
    paste_view,
    save_scene,
    screenshot,
    vsync,
    dismiss,
    larger_interface,
    smaller_interface,
    quit
};

struct Shortcut {
    KeyChord chord;
    Action action;
    std::string_view meaning;
};
[[nodiscard]] std::span<const Shortcut> shortcuts();

[[nodiscard]] Action action_of(const KeyChord& chord);

/// Gestures of the mouse over the picture, for the help page.
struct Gesture {
    std::string_view gesture, meaning;
};
[[nodiscard]] std::span<const Gesture> gestures();

}  // namespace dermis::view
