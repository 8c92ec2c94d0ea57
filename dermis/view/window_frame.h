#pragma once
// The window as a pass list: the pictures in their region, the interface over them.

#include "dermis/technique/pass_list.h"
#include "dermis/view/panels.h"
#include "shaders/renderer/constants.h"

namespace dermis::view {

enum class Arrangement {
    none = kArrangementNone,
    one = kArrangementOne,
    wipe = kArrangementWipe,
    side_by_side = kArrangementSideBySide
};

struct WindowFrame {
    int width = 1, height = 1;
    Region region;
    Arrangement arrangement = Arrangement::none;
    float split = 0.5f, line_px = 1;
    bool has_interface = true;
};

/// Writes the image "window" (sRGB-encoded). Wants the frame inputs picture_a and picture_b, and the
/// interface's draws.
[[nodiscard]] PassList window_passes(const WindowFrame& frame);

}  // namespace dermis::view
