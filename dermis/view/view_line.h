#pragma once
// A view as one line of the command line: what is copied from the window draws the same picture with `dermis
// render`, and comes back by pasting.

#include <string>
#include <string_view>

#include "dermis/render/renderer.h"
#include "dermis/view/model.h"

namespace dermis::view {

/// dermis render SCENE -t ID --set NAME=VALUE ... --scene KEY=VALUE ... --camera "..." --light "..." --size
/// WxH; only what differs from defaults, and from what the scene's files say (`file`), is named. Numbers are
/// rounded: after apply_view_line() of the same line the window shows exactly what it draws. Of `draw` counts
/// the size and the samples.
[[nodiscard]] std::string view_line(Model& model, const Scene& file, const DrawSettings& draw);

/// Takes -t, --set, --scene, --camera, --light, --view, --clip, --time and --morph out of such a line (other
/// words are passed over); "yaw_deg=30 pitch_deg=5" alone is a camera. Nothing changes when any of it is
/// wrong, or when there is nothing to take.
[[nodiscard]] Result<void> apply_view_line(Model& model, std::string_view line);

}  // namespace dermis::view
