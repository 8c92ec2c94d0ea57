#pragma once
// The table behind conversions.h: one row a tool. Not for use elsewhere.

#include <array>
#include <vector>

#include "dermis/optics/conversions.h"

namespace dermis::inline optics {

/// In the order of the convention's keys; scalars in element 0.
using ToolValues = std::vector<Rgb>;

struct ToolRow {
    ToolConvention convention;
    ToolValues (*write)(const BurleyProfile&);
    BurleyProfile (*read)(const ToolValues&);
};

[[nodiscard]] const std::vector<ToolRow>& tool_rows();

}  // namespace dermis::inline optics
