// Expressions by precedence climbing.

#include <array>

#include "dermis/shading/cursor.h"

namespace dermis::shading {
namespace {

// 0: no binary operator.
int precedence(const Token& token) {
    struct Level {
        std::string_view symbol;
        int level;
    };
    static constexpr std::array<Level, 12> kLevels = {{{"||", 1},
                                                       {"&&", 2},
                                                       {"==", 3},
                                                       {"!=", 3},
                                                       {"<", 4},
                                                       {">", 4},
                                                       {"<=", 4},
                                                       {">=", 4},
                                                       {"+", 5},
                                                       {"-", 5},
                                                       {"*", 6},
                                                       {"/", 6}}};
    if (token.kind != Token::Kind::symbol) return 0;
    for (const Level& level : kLevels)
        if (token.text == level.symbol) return level.level;
    return 0;
}

Expression call_of(Cursor& cursor, const Token& name) {
    Expression call{.kind = Expression::Kind::call, .text = name.text, .line = name.line};
    cursor.expect("(", "");
    if (cursor.accept(")")) return call;
    do call.children.push_back(parse_expression(cursor));
    while (cursor.accept(","));
    cursor.expect(")", "close the call");
    return call;
}

Expression primary(Cursor& cursor) {
    const Token token = cursor.take();
    if (token.kind == Token::Kind::number)
        return {.kind = Expression::Kind::number, .text = token.text, .line = token.line};
    if (token.kind == Token::Kind::word) {
        if (cursor.is("(")) return call_of(cursor, token);
        return {.kind = Expression::Kind::name, .text = token.text, .line = token.line};
    }
    if (token.kind == Token::Kind::symbol && token.text == "(") {
        Expression inner = parse_expression(cursor);
        cursor.expect(")", "close the parenthesis");
        return {.kind = Expression::Kind::parentheses,
                .text = "()",
                .children = {std::move(inner)},
                .line = token.line};
    }
    cursor.fail(token.line, token.kind == Token::Kind::comment
                                ? "a comment within an expression; put it before the statement"
                                : "a value is missing before '" + token.text + "'");
    return {};
}

Expression postfix(Cursor& cursor) {
    Expression value = primary(cursor);
    while (cursor.is(".")) {
        const int line = cursor.take().line;
        std::string components = cursor.expect_name("components, as .x or .xyz,");
        value = {.kind = Expression::Kind::swizzle,
                 .text = std::move(components),
                 .children = {std::move(value)},
                 .line = line};
    }
    return value;
}

Expression unary(Cursor& cursor) {
    if (!cursor.is("-") && !cursor.is("!")) return postfix(cursor);
    const Token sign = cursor.take();
    return {
        .kind = Expression::Kind::unary, .text = sign.text, .children = {unary(cursor)}, .line = sign.line};
}

Expression binary(Cursor& cursor, int lowest) {
    Expression left = unary(cursor);
    for (int level = precedence(cursor.peek()); level >= lowest && level > 0;
         level = precedence(cursor.peek())) {
        const Token sign = cursor.take();
        Expression right = binary(cursor, level + 1);
        left = {.kind = Expression::Kind::binary,
                .text = sign.text,
                .children = {std::move(left), std::move(right)},
                .line = sign.line};
    }
    return left;
}

}  // namespace

Expression parse_expression(Cursor& cursor) {
    Expression condition = binary(cursor, 1);
    if (!cursor.is("?")) return condition;
    const int line = cursor.take().line;
    Expression yes = parse_expression(cursor);
    cursor.expect(":", "write CONDITION ? A : B");
    Expression no = parse_expression(cursor);
    return {.kind = Expression::Kind::ternary,
            .text = "?",
            .children = {std::move(condition), std::move(yes), std::move(no)},
            .line = line};
}

}  // namespace dermis::shading
