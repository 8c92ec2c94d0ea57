#include "dermis/view/actions.h"

#include <algorithm>

namespace dermis::view {
namespace {

constexpr Modifiers kCtrl{.ctrl = true};
constexpr Modifiers kShift{.shift = true};

constexpr Shortcut kShortcuts[] = {
    {{kKeyF1, {}}, Action::help, "this page"},
    {{kKeyTab, {}}, Action::panels, "panels away and back"},
    {{{'F'}, {}}, Action::fit, "fit the head into the picture"},
    {{{'T'}, {}}, Action::next_technique, "next technique"},
    {{{'T'}, kShift}, Action::last_technique, "technique before"},
    {{{'V'}, {}}, Action::next_view, "next debug view"},
    {{{'V'}, kShift}, Action::last_view, "debug view before"},
    {{{'0'}, {}}, Action::final_view, "back to the final picture"},
    {{{'R'}, {}}, Action::reset_parameters, "the technique's defaults"},
    {{{']'}, {}}, Action::brighter, "exposure a third of a stop up"},
    {{{'['}, {}}, Action::darker, "exposure a third of a stop down"},
    {{{'C'}, {}}, Action::compare, "compare two techniques: off, wipe, side by side"},
    {{{'X'}, {}}, Action::swap_sides, "left and right change places"},
    {{{'G'}, {}}, Action::ground_truth, "against the ground truth of this view; again: stop"},
    {{{'C'}, kCtrl}, Action::copy_view, "copy this view as a command line"},
    {{{'V'}, kCtrl}, Action::paste_view, "paste a view"},
    {{{'S'}, kCtrl}, Action::save_scene, "save the scene with what was changed"},
    {{kKeyF12, {}}, Action::screenshot, "the picture as a PNG"},
    {{{'Y'}, {}}, Action::vsync, "wait for the display, or not"},
    {{kKeyEscape, {}}, Action::dismiss, "messages away"},
    {{{'='}, kCtrl}, Action::larger_interface, "larger interface"},
    {{{'-'}, kCtrl}, Action::smaller_interface, "smaller interface"},
    {{{'Q'}, kCtrl}, Action::quit, "quit"},
};

constexpr Gesture kGestures[] = {
    {"drag", "turn the head"},
    {"shift+drag, or middle button", "move it"},
    {"wheel", "closer, farther"},
    {"ctrl+drag, or right button", "turn the key light"},
    {"drag the white line", "wipe between two techniques"},
    {"drop a file", "a scene or mesh; .hdr: surroundings; .exr, .png: compare"},
    {"right click on a value", "back to its default"},
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
