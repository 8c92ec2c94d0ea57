#pragma once
// The words and ticks beneath the colour bar of a debug view; shaders/renderer/view.frag draws the bar
// itself.

#include <string_view>

#include "dermis/image/image.h"

namespace dermis::inline render {

inline constexpr int kLegendWidth = 320, kLegendHeight = 44;

/// Whether a view's colours have a scale.
[[nodiscard]] bool has_legend(std::string_view view);

/// One channel, u8: coverage of ink on each pixel of the legend, kLegendWidth x kLegendHeight. curvature:
/// -0.125 to 0.125 in 1/mm; n_dot_l: -1 to 1; blank for views without a scale. Error: no font
/// (image/label.h).
[[nodiscard]] Result<Image> make_legend(std::string_view view);

}  // namespace dermis::inline render
