#include "dermis/view/actions.h"

#include <algorithm>

namespace dermis::view {
namespace {

constexpr Modifiers kCtrl{.ctrl = true};
constexpr Modifiers kShift{.shift = true};
constexpr Modifiers kCtrlShift{.shift = true, .ctrl = true};

constexpr Shortcut kShortcuts[] = {
    {{kKeyF1, {}}, Action::help, "this page"},
    {{kKeyTab, {}}, Action::panels, "hide or show the panels"},
    {{{'F'}, {}}, Action::fit, "show the whole head"},
    {{{'T'}, {}}, Action::next_technique, "next technique"},
    {{{'T'}, kShift}, Action::last_technique, "previous technique"},
    {{{'V'}, {}}, Action::next_view, "next debug view"},
    {{{'V'}, kShift}, Action::last_view, "previous debug view"},
    {{{'0'}, {}}, Action::final_view, "the final picture"},
    {{{'R'}, {}}, Action::reset_parameters, "set the technique's parameters to their defaults"},
    {{{']'}, {}}, Action::brighter, "raise the exposure by a third of a stop"},
    {{{'['}, {}}, Action::darker, "lower the exposure by a third of a stop"},
    {{{'C'}, {}}, Action::compare, "compare two techniques: off, wipe, side by side"},
    {{{'X'}, {}}, Action::swap_sides, "exchange left and right side"},
    {{{'G'}, {}}, Action::reference, "compare with the reference of this view; again: stop"},
    {{kKeySpace, {}}, Action::play, "play or pause the clip of a mesh that moves"},
    {{{'O'}, kCtrl}, Action::open, "open a scene, mesh or picture by its path"},
    {{{'Z'}, kCtrl}, Action::undo, "undo the last change of a panel"},
    {{{'Z'}, kCtrlShift}, Action::redo, "redo what was undone"},
    {{{'C'}, kCtrl}, Action::copy_view, "copy this view as a command line"},
    {{{'V'}, kCtrl}, Action::paste_view, "paste a view"},
    {{{'S'}, kCtrl}, Action::save_scene, "save the scene with what was changed"},
    {{kKeyF12, {}}, Action::screenshot, "save the picture as a PNG"},
    {{{'Y'}, {}}, Action::vsync, "vertical sync on or off"},
    {{kKeyEscape, {}}, Action::dismiss, "close this page and the messages"},
    {{{'='}, kCtrl}, Action::larger_interface, "larger interface"},
    {{{'-'}, kCtrl}, Action::smaller_interface, "smaller interface"},
    {{{'Q'}, kCtrl}, Action::quit, "quit"},
};

constexpr Gesture kGestures[] = {
    {"drag", "turn the camera around the head"},
    {"shift+drag, or middle button", "move the camera"},
    {"wheel", "change the camera's distance"},
    {"ctrl+drag, or right button", "turn the key light"},
    {"drag the white line", "move the border between two techniques"},
    {"drop a file", "a scene or mesh; .hdr: environment; .exr, .png: compare"},
    {"right click on a value", "set it to its default"},
    {"ctrl+click on a slider", "type the number"},
};

}  // namespace

std::span<const Shortcut> shortcuts() {
    return kShortcuts;
}
std::span<const Gesture> gestures() {
    return kGestures;
}

Action action_of(const KeyChord& chord) {
    const auto found = std::ranges::find(kShortcuts, chord, &Shortcut::chord);
    return found == std::end(kShortcuts) ? Action::none : found->action;
}

}  // namespace dermis::view
