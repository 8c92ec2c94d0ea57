#pragma once
// Checks after parsing: names, types, and constructs that some language lacks.

#include <vector>

#include "dermis/base/result.h"
#include "dermis/shading/syntax.h"

namespace dermis::shading {

/// Sets the type of every expression and which variables change. `units` in the order of their includes; each
/// sees what those before it define. Errors, with file and line: an unknown name, types that do not fit, two
/// functions of one name (WGSL and C do not overload), an assignment to a parameter (WGSL's are constant) or
/// to several components, a name that a language reserves.
[[nodiscard]] Result<void> check(std::vector<Unit>& units);

/// The language that reserves this name; empty when none does.
[[nodiscard]] std::string_view reserved_by(std::string_view name);

}  // namespace dermis::shading
