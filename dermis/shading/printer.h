#pragma once
// A tree to text in one dialect. Expressions hold marks where a line may be broken; wrap() uses them.

#include <string>
#include <vector>

#include "dermis/shading/dialect.h"
#include "dermis/shading/syntax.h"

namespace dermis::shading {

/// Wider lines are broken.
inline constexpr size_t kLineWidth = 120;

/// A space, or a line break where a line is too long: rather at a small depth.
[[nodiscard]] std::string break_mark(int depth);
/// The line with its marks as spaces, or broken and continued two levels further in. With a newline at the
/// end.
[[nodiscard]] std::string wrap(const std::string& marked_line, size_t indent);

/// With break marks; `depth` is that of the outermost one.
[[nodiscard]] std::string expression_text(const Expression& expression, const Dialect& dialect, int depth);

/// A function or a constant with its comments, complete lines.
[[nodiscard]] std::string item_text(const Item& item, const Dialect& dialect);

[[nodiscard]] std::string comment_text(const std::vector<std::string>& lines, size_t indent);

}  // namespace dermis::shading
