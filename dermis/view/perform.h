#pragma once
// Does what keys and panels ask for.

#include "dermis/view/actions.h"
#include "dermis/view/parts.h"

namespace dermis::view {

void perform(Parts& parts, Action action);

/// The scene with what was changed, as a scene file.
[[nodiscard]] Result<void> save_scene(Parts& parts, const std::string& path);

}  // namespace dermis::view
