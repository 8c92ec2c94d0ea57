#pragma once
// A disc laid flat without folds.

#include <functional>

#include "dermis/base/vec.h"
#include "subjects/bust/charts.h"

namespace dermis::bust {

struct FlattenOptions {
    double width = 1, height = 1;          ///< of the flat piece; a rounded rectangle (superellipse)
    double roundness = 4;                  ///< superellipse exponent: 2 an ellipse, large a rectangle
    int rounds = 5;                        ///< of stretch reduction
    std::function<double(Point)> density;  ///< wished size in the atlas, relative; empty: 1 everywhere
};

/// u right, v UP, inside [0, width] x [0, height]; seen from outside. Every triangle keeps its orientation
/// (Tutte's theorem: convex boundary, positive weights). Holes are spanned, not used.
[[nodiscard]] std::vector<Point> flatten(const Chart& chart, const FlattenOptions& options);

/// Ratio of the larger to the smaller stretch of every triangle (1: angles kept).
[[nodiscard]] std::vector<double> anisotropy(const Surface& mesh, const std::vector<Point>& flat);

}  // namespace dermis::bust
