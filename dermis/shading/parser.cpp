#include "dermis/shading/parser.h"

#include <array>

#include "dermis/shading/lexer.h"

namespace dermis::shading {
namespace {

// Expressions by precedence climbing. The cursor is at the first token of one; afterwards behind its last.
Expression parse_expression(Cursor& cursor);

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

std::vector<Statement> parse_body(Cursor& cursor, bool& braces);

Comments comments_before(Cursor& cursor) {
    Comments comments{.blank_line_before = cursor.peek().blank_line_before};
    while (cursor.peek().kind == Token::Kind::comment) comments.before.push_back(cursor.take().text);
    return comments;
}

void comment_behind(Cursor& cursor, Comments& comments) {
    if (cursor.peek().kind == Token::Kind::comment && !cursor.peek().first_on_line)
        comments.behind = cursor.take().text;
}

Type expect_type(Cursor& cursor) {
    const Token word = cursor.peek();
    const std::string name = cursor.expect_name("a type");
    const std::optional<Type> type = find_type(name);
    if (!type && !cursor.error())
        cursor.fail(word.line,
                    "'" + name + "' is not a type of the subset; it has float, vec2, vec3, vec4, int, bool");
    return type.value_or(Type::scalar);
}

bool is_declaration(const Cursor& cursor) {
    return cursor.is("const") || (cursor.peek().kind == Token::Kind::word && find_type(cursor.peek().text) &&
                                  cursor.peek(1).kind == Token::Kind::word);
}

// "const float a = 1.0, b = 2.0" without the semicolon.
Statement parse_declaration(Cursor& cursor) {
    Statement statement{.kind = Statement::Kind::declaration, .line = cursor.peek().line};
    statement.constant = cursor.accept("const");
    statement.type = expect_type(cursor);
    do {
        Declarator declarator{.name = cursor.expect_name("a name")};
        if (cursor.accept("=")) declarator.value = parse_expression(cursor);
        if (statement.constant && !declarator.value && !cursor.error())
            cursor.fail(statement.line, "constant '" + declarator.name + "' has no value; write = VALUE");
        statement.declarators.push_back(std::move(declarator));
    } while (cursor.accept(","));
    return statement;
}

// "a.x += 1.0", "++i", "i++", without the semicolon.
Statement parse_assignment(Cursor& cursor) {
    Statement statement{.kind = Statement::Kind::assignment, .line = cursor.peek().line};
    const bool prefix = cursor.is("++") || cursor.is("--");
    if (prefix) statement.operation = cursor.take().text;
    statement.target = cursor.expect_name("a statement: a declaration, an assignment, if, for or return,");
    if (cursor.accept(".")) statement.target += "." + cursor.expect_name("a component");
    if (prefix) return statement;
    statement.operation = cursor.take().text;
    if (statement.operation == "++" || statement.operation == "--") return statement;
    if (statement.operation != "=" && statement.operation != "+=" && statement.operation != "-=" &&
        statement.operation != "*=" && statement.operation != "/=")
        cursor.fail(statement.line,
                    "'" + statement.target + " " + statement.operation +
                        "' is not a statement of the subset; it has declarations, assignments, if, "
                        "for and return");
    statement.expressions.push_back(parse_expression(cursor));
    return statement;
}

Statement parse_if(Cursor& cursor) {
    Statement statement{.kind = Statement::Kind::if_else, .line = cursor.take().line};
    cursor.expect("(", "write if (CONDITION)");
    statement.expressions.push_back(parse_expression(cursor));
    cursor.expect(")", "write if (CONDITION)");
    statement.body = parse_body(cursor, statement.braces);
    if (cursor.accept("else")) statement.otherwise = parse_body(cursor, statement.else_braces);
    return statement;
}

// for (int i = 0; i < n; ++i): one counter, which is what every language writes alike.
Statement parse_for(Cursor& cursor) {
    Statement statement{.kind = Statement::Kind::for_loop, .line = cursor.take().line};
    const char* advice = "write for (int i = 0; i < COUNT; ++i)";
    cursor.expect("(", advice);
    Statement counter = parse_declaration(cursor);
    if (counter.type != Type::integer || counter.declarators.size() != 1 || !counter.declarators[0].value)
        cursor.fail(statement.line, std::string("a loop counts one int; ") + advice);
    statement.declarators = std::move(counter.declarators);
    cursor.expect(";", advice);
    statement.expressions.push_back(parse_expression(cursor));
    cursor.expect(";", advice);
    const Statement step = parse_assignment(cursor);
    if (!statement.declarators.empty() &&
        (step.operation != "++" || step.target != statement.declarators[0].name))
        cursor.fail(statement.line, std::string("a loop counts upwards by 1; ") + advice);
    cursor.expect(")", advice);
    statement.body = parse_body(cursor, statement.braces);
    return statement;
}

Statement parse_simple(Cursor& cursor) {
    Statement statement;
    if (is_declaration(cursor)) {
        statement = parse_declaration(cursor);
    } else if (cursor.is("return")) {
        statement.line = cursor.take().line;
        statement.expressions.push_back(parse_expression(cursor));
    } else {
        statement = parse_assignment(cursor);
    }
    cursor.expect(";", "end the statement");
    return statement;
}

Statement parse_statement(Cursor& cursor) {
    Comments comments = comments_before(cursor);
    for (const char* word : {"while", "do", "switch", "discard", "break", "continue"})
        if (cursor.is(word))
            cursor.fail(cursor.peek().line,
                        "'" + std::string(word) + "' is not of the subset; write it with if, for and return");
    Statement statement = cursor.is("if")    ? parse_if(cursor)
                          : cursor.is("for") ? parse_for(cursor)
                                             : parse_simple(cursor);
    comment_behind(cursor, comments);
    statement.comments = std::move(comments);
    return statement;
}

std::vector<Statement> parse_body(Cursor& cursor, bool& braces) {
    std::vector<Statement> body;
    braces = cursor.accept("{");
    if (!braces) {
        body.push_back(parse_statement(cursor));
        return body;
    }
    while (!cursor.is("}") && !cursor.at_end()) {
        if (cursor.peek().kind == Token::Kind::comment && cursor.peek().first_on_line) {
            size_t ahead = 0;
            while (cursor.peek(ahead).kind == Token::Kind::comment) ++ahead;
            if (cursor.peek(ahead).text == "}")
                cursor.fail(cursor.peek().line, "a comment without a statement behind it; put it before one");
        }
        body.push_back(parse_statement(cursor));
    }
    cursor.expect("}", "close the block");
    return body;
}

Parameter parse_parameter(Cursor& cursor) {
    for (const char* word : {"in", "out", "inout", "const"})
        if (cursor.is(word))
            cursor.fail(cursor.peek().line,
                        "'" + std::string(word) +
                            "' at a parameter: WGSL has none; return the value, one function each");
    const Type type = expect_type(cursor);
    return {type, cursor.expect_name("the parameter's name")};
}

Item parse_item(Cursor& cursor) {
    Item item{.comments = comments_before(cursor)};
    item.line = cursor.peek().line;
    if (cursor.is("const")) {
        item.constants.push_back(parse_declaration(cursor));
        cursor.expect(";", "end the declaration");
        comment_behind(cursor, item.comments);
        return item;
    }
    if (cursor.peek().text == "struct" || cursor.peek().text == "uniform" || cursor.peek().text == "layout" ||
        cursor.peek().text == "void")
        cursor.fail(item.line,
                    "'" + cursor.peek().text +
                        "' is not of the subset; write a function that gets values and returns one");
    item.type = expect_type(cursor);
    item.name = cursor.expect_name("the function's name");
    cursor.expect("(", "write a function, or const before a constant");
    if (!cursor.is(")")) do
            item.parameters.push_back(parse_parameter(cursor));
        while (cursor.accept(","));
    cursor.expect(")", "close the parameters");
    if (!cursor.is("{") && !cursor.error())
        cursor.fail(item.line, "'" + item.name + "' is declared without a body; define it here");
    bool braces = false;
    item.body = parse_body(cursor, braces);
    return item;
}

// The include guard and includes of the same folder; everything else of the preprocessor is an error.
void parse_directive(Cursor& cursor, Unit& unit) {
    const Token token = cursor.take();
    const std::string& text = token.text;
    if (text.starts_with("#include \"") && text.ends_with("\""))
        unit.includes.push_back(text.substr(10, text.size() - 11));
    else if (!text.starts_with("#ifndef DERMIS_") && !text.starts_with("#define DERMIS_") && text != "#endif")
        cursor.fail(token.line, "'" + text + "' is not of the subset; it has include guards and #include");
}

}  // namespace

Result<Unit> parse(const std::string& path, std::string_view text) {
    DERMIS_TRY_ASSIGN(std::vector<Token> tokens, tokenize(path, text));
    Cursor cursor(path, std::move(tokens));
    Unit unit{.path = path};
    // A comment with a blank line or a directive behind it is the file's; else it is of what follows.
    size_t lines = 0;
    while (cursor.peek(lines).kind == Token::Kind::comment) ++lines;
    if (cursor.peek(lines).kind == Token::Kind::directive || cursor.peek(lines).blank_line_before)
        while (lines-- > 0) unit.header.push_back(cursor.take().text);
    while (!cursor.at_end())
        if (cursor.peek().kind == Token::Kind::directive)
            parse_directive(cursor, unit);
        else
            unit.items.push_back(parse_item(cursor));
    if (cursor.error()) return *cursor.error();
    return unit;
}

}  // namespace dermis::shading
