#pragma once

#include <vector>

#include "dermis/technique/figure.h"

namespace dermis::spherical_gaussians {

/// The source's comparison of widths with its reference, on spheres.
[[nodiscard]] std::vector<Figure> figures();

}  // namespace dermis::spherical_gaussians
