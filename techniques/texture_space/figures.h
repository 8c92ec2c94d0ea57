#pragma once

#include <vector>

#include "dermis/technique/figure.h"

namespace dermis {

/// The source's figures, 2.8.1 to 2.8.8.
[[nodiscard]] std::vector<Figure> texture_space_figures();

}  // namespace dermis
