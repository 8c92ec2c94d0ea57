#pragma once
// How the interface looks.

namespace dermis::view {

/// Colours and measures of the present ImGui context; every length times `scale`.
void set_style(float scale);

}  // namespace dermis::view
