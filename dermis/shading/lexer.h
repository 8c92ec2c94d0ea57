#pragma once
// A source as tokens. Comments and directives are tokens too, as both are kept or judged.

#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"

namespace dermis::shading {

struct Token {
    enum class Kind { word, number, symbol, comment, directive, end };
    Kind kind = Kind::end;
    std::string text = {};  ///< of a comment without "//" and one space
    int line = 0;
    bool first_on_line = false, blank_line_before = false;
};

/// A letter, a digit or _.
[[nodiscard]] bool is_word(char c);

/// Ends with a token of kind end. Errors: a character or a comment that is not of the subset.
[[nodiscard]] Result<std::vector<Token>> tokenize(const std::string& path, std::string_view text);

/// "path:line: what"
[[nodiscard]] Error error_at(const std::string& path, int line, const std::string& what);

}  // namespace dermis::shading
