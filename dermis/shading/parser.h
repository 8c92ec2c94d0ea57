#pragma once
// Text to a checked tree.

#include <vector>

#include "dermis/base/result.h"
#include "dermis/shading/lexer.h"
#include "dermis/shading/syntax.h"

namespace dermis::shading {

/// Errors: whatever the subset does not have, with file, line and what to write instead. Names and types are
/// not looked at: check() does that.
[[nodiscard]] Result<Unit> parse(const std::string& path, std::string_view text);

/// Checks names, types, and constructs that some language lacks. Sets the type of every expression and which
/// variables change. `units` in the order of their includes; each sees what those before it define. Errors,
/// with file and line: an unknown name, types that do not fit, two functions of one name (WGSL and C do not
/// overload), an assignment to a parameter (WGSL's are constant) or to several components, a name that a
/// language reserves.
[[nodiscard]] Result<void> check(std::vector<Unit>& units);

}  // namespace dermis::shading
