#pragma once
// A source as tokens. Comments and directives are tokens too, as both are kept or judged.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/shading/syntax.h"

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

/// A place in the tokens, and the first error. After an error the cursor is at the end, so that every loop
/// over tokens ends; whoever started the parsing looks at error().
class Cursor {
  public:
    Cursor(std::string path, std::vector<Token> tokens)
        : path_(std::move(path)), tokens_(std::move(tokens)) {}

    [[nodiscard]] const Token& peek(size_t ahead = 0) const {
        return tokens_[at_ + ahead < tokens_.size() ? at_ + ahead : tokens_.size() - 1];
    }
    [[nodiscard]] bool at_end() const { return peek().kind == Token::Kind::end; }
    [[nodiscard]] bool is(std::string_view text) const {
        return (peek().kind == Token::Kind::symbol || peek().kind == Token::Kind::word) &&
               peek().text == text;
    }
    Token take() {
        Token token = peek();
        if (at_ + 1 < tokens_.size()) ++at_;
        return token;
    }
    /// Takes it if it is there.
    bool accept(std::string_view text) {
        if (!is(text)) return false;
        take();
        return true;
    }
    /// Takes it, or fails.
    void expect(std::string_view text, std::string_view advice);
    /// A name, or a failure and "".
    std::string expect_name(std::string_view of_what);

    void fail(int line, const std::string& what);
    [[nodiscard]] const std::optional<Error>& error() const { return error_; }

  private:
    std::string path_;
    std::vector<Token> tokens_;
    size_t at_ = 0;
    std::optional<Error> error_;
};

}  // namespace dermis::shading
