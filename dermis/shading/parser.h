#pragma once
// Tokens to a tree.

#include "dermis/shading/lexer.h"
#include "dermis/shading/syntax.h"

namespace dermis::shading {

/// Errors: whatever the subset does not have, with file, line and what to write instead. Names and types are
/// not looked at: check.h does that.
[[nodiscard]] Result<Unit> parse(const std::string& path, std::string_view text);

}  // namespace dermis::shading
