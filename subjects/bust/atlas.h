#pragma once
// The charts laid out in one square, 0..1.

#include "subjects/bust/charts.h"

namespace dermis::bust {

/// Texels between charts, and between a chart and the border, of a 2048 atlas.
inline constexpr int kAtlasSide = 2048;
inline constexpr int kGutter = 10;

struct Atlas {
    Surface mesh;                 ///< all charts; vertices on seams once a side
    std::vector<Point> uvs;       ///< u right, v DOWN, z unused
    std::vector<ChartKind> kind;  ///< of every triangle
};

/// About 1 s on one core.
[[nodiscard]] Atlas make_atlas(const Surface& surface, const BustField& field);

}  // namespace dermis::bust
