#pragma once
// UI script: simulated mouse and keyboard, for tests and demonstrations. One command a line, '#' starts a
// comment; words with spaces are written in double quotes.
// docs/view.md lists the commands.

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/output_check.h"
#include "dermis/view/event.h"
#include "dermis/view/panels.h"

namespace dermis::view {

enum class CommandKind {
    open,
    technique,
    set,
    view,
    tone,
    scene,
    clip,
    time,
    play,
    pause,
    morph,
    drag,
    scroll,
    key,
    type,
    slide,
    click,
    undo,
    redo,
    drop,
    copy,
    save,
    clipboard,
    resize,
    minimise,
    restore,
    wait,
    settle,
    screenshot,
    capture,
    lose_device,
    print,
    quit
};

struct ScriptCommand {
    CommandKind kind = CommandKind::wait;
    int line = 1;
    std::vector<std::string> words;  ///< after the command
    std::vector<double> numbers;     ///< those of the words that must be numbers, in order
    MouseButton button = MouseButton::left;
    Modifiers modifiers;
    KeyChord chord;
};

/// Largest script, in bytes.
inline constexpr size_t kMaxScriptBytes = size_t{1} << 20;

/// Errors: "FILE:LINE: ...", naming the command and what it wants.
[[nodiscard]] Result<std::vector<ScriptCommand>> parse_script(std::string_view text, const std::string& file);

/// The pictures and scenes that a script writes. Scenes may be saved again, pictures not.
[[nodiscard]] FileUse script_files(const std::vector<ScriptCommand>& script);

/// The events of a command that is input, one batch a frame; empty for the others.
[[nodiscard]] std::deque<std::vector<Event>> input_frames(const ScriptCommand& command);
/// A click on the middle of a widget.
[[nodiscard]] std::deque<std::vector<Event>> click_frames(const Region& widget);
/// A drag of a widget's handle to `share` of its width, from its middle.
[[nodiscard]] std::deque<std::vector<Event>> slide_frames(const Region& widget, double share);

}  // namespace dermis::view
