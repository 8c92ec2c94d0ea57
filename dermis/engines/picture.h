#pragma once
// The picture of a package's README.

#include <cstddef>
#include <vector>

#include "dermis/bake/table.h"
#include "dermis/base/result.h"

namespace dermis::inline engines::packages {

/// A PNG: spheres of 4, 8 and 16 mm lit from the right, above as the table has them, below Lambert's.
[[nodiscard]] Result<std::vector<std::byte>> picture_of(const Table& table);

}  // namespace dermis::inline engines::packages
