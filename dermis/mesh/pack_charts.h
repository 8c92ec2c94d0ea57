#pragma once
// Packs charts of an atlas into the unit square by their outlines: a chart may fill a concave part of
// another.

#include <array>
#include <span>
#include <vector>

#include "dermis/base/vec.h"

namespace dermis::inline mesh {

/// A chart's place in the unit square: rotated by a multiple of 90 degrees, never mirrored.
struct PackedChart {
    Vec2 origin, x_axis, y_axis;
    [[nodiscard]] Vec2 at(Vec2 p) const { return origin + x_axis * p.x + y_axis * p.y; }
};

/// Triangles of charts, in one unit, as PackedCharts of one scale, the largest that was found. At least about
/// `gap` of the square's side lies between charts, and half of it to the border; less where thousands of
/// charts leave no room for it.
[[nodiscard]] std::vector<PackedChart> pack_charts(std::span<const std::vector<std::array<Vec2, 3>>> charts,
                                                   float gap);

}  // namespace dermis::inline mesh
