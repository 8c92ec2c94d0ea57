#pragma once
// Words between spaces, with quotes around those that hold some.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dermis::view {

/// `quotes`: the characters that quote; `comment` ends the text outside of them (0: none does). Nothing when
/// a quote is left open.
[[nodiscard]] std::optional<std::vector<std::string>> quoted_words(std::string_view text,
                                                                   std::string_view quotes, char comment = 0);

}  // namespace dermis::view
