#include "dermis/shading/cursor.h"

namespace dermis::shading {

void Cursor::expect(std::string_view text, std::string_view mend) {
    if (accept(text)) return;
    std::string what = "'" + std::string(text) + "' is missing before '" + peek().text + "'";
    if (at_end()) what = "'" + std::string(text) + "' is missing at the end of the file";
    if (peek().kind == Token::Kind::comment) what = "a comment within a statement";
    if (!mend.empty()) what += "; " + std::string(mend);
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
