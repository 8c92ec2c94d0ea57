#pragma once
// The figures of the two articles this technique follows; see `dermis figures preintegrated`.

#include <vector>

#include "dermis/technique/figure.h"

namespace dermis::preintegrated {

/// Of the Unity implementation: the table, curvature, bumps, specular, parts and whole, shadow.
[[nodiscard]] std::vector<Figure> unity_figures();

/// Of Yeung 2015: curves beside tables, spheres, heads, environments; and the baselines.
[[nodiscard]] std::vector<Figure> curve_figures();

}  // namespace dermis::preintegrated
