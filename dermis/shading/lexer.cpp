#include "dermis/shading/lexer.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "dermis/base/text.h"

namespace dermis::shading {
namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

class Lexer {
  public:
    Lexer(const std::string& path, std::string_view text) : path_(path), text_(text) {}

    Result<std::vector<Token>> run() {
        while (skip_space()) {
            const size_t start = at_;
            Token token{.line = line_, .first_on_line = at_line_start_, .blank_line_before = newlines_ > 1};
            DERMIS_TRY(read_token(token));
            if (token.text.empty() && token.kind != Token::Kind::comment)
                token.text = std::string(text_.substr(start, at_ - start));
            tokens_.push_back(std::move(token));
            at_line_start_ = false;
            newlines_ = 0;
        }
        tokens_.push_back({.line = line_, .first_on_line = true});
        return std::move(tokens_);
    }

  private:
    char peek(size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

    // False at the end of the text.
    bool skip_space() {
        for (; at_ < text_.size() && std::isspace(static_cast<unsigned char>(peek())); ++at_)
            if (peek() == '\n') {
                ++line_;
                ++newlines_;
                at_line_start_ = true;
            }
        return at_ < text_.size();
    }

    std::string rest_of_line() {
        const size_t start = at_, end = std::min(text_.find('\n', at_), text_.size());
        at_ = end;
        return std::string(trim(text_.substr(start, end - start)));
    }

    void read_number() {
        while (is_digit(peek()) || peek() == '.') ++at_;
        if (peek() == 'e' || peek() == 'E') {
            ++at_;
            if (peek() == '-' || peek() == '+') ++at_;
            while (is_digit(peek())) ++at_;
        }
    }

    Result<void> read_token(Token& token) {
        const char c = peek();
        if (c == '#') {
            token.kind = Token::Kind::directive;
            token.text = rest_of_line();
        } else if (c == '/' && peek(1) == '/') {
            token.kind = Token::Kind::comment;
            at_ += 2;
            if (peek() == ' ') ++at_;
            const bool indented = peek() == ' ';  // a formula
            const size_t spaces = std::min(text_.find_first_not_of(' ', at_), text_.size()) - at_;
            token.text = rest_of_line();
            if (indented && !token.text.empty()) token.text.insert(0, spaces, ' ');
        } else if (c == '/' && peek(1) == '*') {
            return error_at(path_, line_, "a comment in /* */; write // at the head of each line");
        } else if (is_digit(c) || (c == '.' && is_digit(peek(1)))) {
            token.kind = Token::Kind::number;
            read_number();
            if (is_word(peek())) return error_at(path_, line_, "a number with a suffix; write it without");
        } else if (is_word(c)) {
            token.kind = Token::Kind::word;
            while (is_word(peek())) ++at_;
        } else {
            return read_symbol(token);
        }
        return {};
    }

    Result<void> read_symbol(Token& token) {
        token.kind = Token::Kind::symbol;
        static constexpr std::array<std::string_view, 12> kDouble = {"<=", ">=", "==", "!=", "&&", "||",
                                                                     "+=", "-=", "*=", "/=", "++", "--"};
        for (const std::string_view two : kDouble)
            if (text_.substr(at_, 2) == two) {
                at_ += 2;
                return {};
            }
        if (std::string_view("+-*/<>=!?:;,.(){}").find(peek()) == std::string_view::npos)
            return error_at(path_, line_,
                            "'" + printable_line(text_.substr(at_, 1)) +
                                "' is not of the subset; write it with + - * /, calls, swizzles and if");
        ++at_;
        return {};
    }

    const std::string& path_;
    std::string_view text_;
    size_t at_ = 0;
    int line_ = 1, newlines_ = 0;
    bool at_line_start_ = true;
    std::vector<Token> tokens_;
};

}  // namespace

bool is_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

Error error_at(const std::string& path, int line, const std::string& what) {
    return {fmt::format("{}:{}: {}", path, line, what)};
}

Result<std::vector<Token>> tokenize(const std::string& path, std::string_view text) {
    return Lexer(path, text).run();
}

void Cursor::expect(std::string_view text, std::string_view advice) {
    if (accept(text)) return;
    std::string what = "'" + std::string(text) + "' is missing before '" + peek().text + "'";
    if (at_end()) what = "'" + std::string(text) + "' is missing at the end of the file";
    if (peek().kind == Token::Kind::comment) what = "a comment within a statement";
    if (!advice.empty()) what += "; " + std::string(advice);
    fail(peek().line, what);
}

std::string Cursor::expect_name(std::string_view of_what) {
    if (peek().kind == Token::Kind::word) return take().text;
    const std::string found = at_end() ? "the end of the file" : "'" + peek().text + "'";
    fail(peek().line, std::string(of_what) + " is missing before " + found);
    return {};
}

void Cursor::fail(int line, const std::string& what) {
    if (error_) return;
    error_ = error_at(path_, line, what);
    at_ = tokens_.size() - 1;
}

}  // namespace dermis::shading
