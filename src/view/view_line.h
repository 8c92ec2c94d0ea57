#pragma once
// A view as one line of the command line: what is copied from the window draws the same picture with `dermis
// render`, and comes back by pasting.

#include <string>
#include <string_view>

#include "dermis/view/model.h"

namespace dermis::view {

/// dermis render SCENE -t ID --set NAME=VALUE ... --camera "..." --light "..." --size WxH; only settings that
/// differ from their defaults are named.
[[nodiscard]] std::string view_line(Model& model, int width, int height);

/// Takes -t, --set, --camera, --light and --view out of such a line (other words are passed over); "yaw=30
/// pitch=5" alone is a camera. Nothing changes when any of it is wrong, or when there is nothing to take.
[[nodiscard]] Result<void> apply_view_line(Model& model, std::string_view line);

}  // namespace dermis::view
