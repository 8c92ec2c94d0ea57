#pragma once
// UI script: simulated mouse and keyboard, for tests and demonstrations. One command a line, '#' starts a
// comment; words with spaces are written in double quotes.
//
//     open spheres                    # a scene, a mesh, a name
//     technique preintegrated
//     set shadow_width_mm=4           # a parameter
//     view curvature
//     tone 5                          # 0: as the maps are, 1 to 6: skin I to VI
//     drag left 300 300 420 280       # button, from, to in pixels; then ctrl, shift or alt
//     scroll 300 300 -3
//     key ctrl+C
//     slide picture.exposure_ev 0.7   # drags a widget to a share of its range
//     drop head.glb
//     copy broken.frag shaders/a/b.frag   # files; changes a watched file
//     save scene.toml                 # the scene with what was changed
//     clipboard "yaw_deg=30"          # as if copied elsewhere
//     resize 640 480
//     wait 5                          # frames
//     settle                          # until the picture has its full quality
//     screenshot picture.png          # the picture alone; .exr is linear
//     capture window.png              # the window with its panels
//     lose_device                     # simulates the loss of the GPU: everything on it is made again
//     print                           # the state, on standard output
//     quit                            # also the end of the script, without --frames

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/view/event.h"
#include "dermis/view/panels.h"

namespace dermis::view {

enum class CommandKind {
    open,
    technique,
    set,
    view,
    tone,
    drag,
    scroll,
    key,
    slide,
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

/// The events of a command that is input, one batch a frame; empty for the others.
[[nodiscard]] std::deque<std::vector<Event>> input_frames(const ScriptCommand& command);
/// A drag of a widget's handle to `share` of its width, from its middle.
[[nodiscard]] std::deque<std::vector<Event>> slide_frames(const Region& widget, double share);

}  // namespace dermis::view
