#pragma once
// The figures of the two articles this technique follows; see `dermis figures preintegrated`.

#include <vector>

#include "dermis/technique/figure.h"

namespace dermis {

[[nodiscard]] std::vector<Figure> preintegrated_figures();

}  // namespace dermis
