// A tree to text in one dialect. Expressions hold marks where a line may be broken; wrap() uses them.

#include <algorithm>
#include <cctype>

#include "dermis/shading/dialect.h"

namespace dermis::shading {
namespace {

constexpr size_t kLineWidth = 120;  // wider lines are broken
constexpr size_t kIndent = 4;
constexpr unsigned char kFirstMark = 0x80;
constexpr int kDeepest = 0x7F;

bool is_mark(char c) {
    return static_cast<unsigned char>(c) >= kFirstMark;
}

// A space, or a line break where a line is too long: rather at a small depth.
std::string break_mark(int depth) {
    return {char(kFirstMark + static_cast<unsigned char>(std::min(depth, kDeepest)))};
}

// The line with its marks as spaces, or broken and continued two levels further in.
std::string wrap(const std::string& marked_line, size_t indent) {
    std::string text, line = std::string(indent, ' ') + marked_line;
    while (line.size() > kLineWidth) {
        size_t best = 0;  // the last of the marks of the smallest depth that fits
        for (size_t i = indent + 8; i < kLineWidth; ++i)
            if (is_mark(line[i]) &&
                (best == 0 || static_cast<unsigned char>(line[i]) <= static_cast<unsigned char>(line[best])))
                best = i;
        if (best == 0) break;
        text += line.substr(0, best) + "\n";
        line = std::string(indent + 8, ' ') + line.substr(best + 1);
    }
    text += line + "\n";
    std::ranges::replace_if(text, is_mark, ' ');
    return text;
}

class ExpressionPrinter {
  public:
    explicit ExpressionPrinter(const Dialect& dialect) : dialect_(dialect) {}

    std::string print(const Expression& e, int depth) const {
        switch (e.kind) {
            case Expression::Kind::number:
                return e.text + std::string(suffix(e));
            case Expression::Kind::name:
                return e.text;
            case Expression::Kind::unary:
                return e.text + print(e.children[0], depth);
            case Expression::Kind::parentheses:
                return "(" + print(e.children[0], depth + 1) + ")";
            case Expression::Kind::swizzle:
                return swizzle(e, depth);
            case Expression::Kind::binary: {
                // A sum breaks before its products do.
                const int own = depth + (e.text == "*" || e.text == "/" ? 1 : 0);
                return print(e.children[0], own) + " " + e.text + break_mark(own) + print(e.children[1], own);
            }
            case Expression::Kind::ternary:
                return ternary(e, depth);
            case Expression::Kind::call:
                return call(e, depth);
        }
        return {};
    }

  private:
    std::string_view suffix(const Expression& e) const {
        return e.type == Type::scalar ? dialect_.number_suffix : std::string_view{};
    }

    std::string type(Type type) const { return std::string(dialect_.types[size_t(type)]); }

    std::string swizzle(const Expression& e, int depth) const {
        const std::string base = print(e.children[0], depth);
        if (!dialect_.spells_swizzles) return base + "." + e.text;
        std::string all;
        for (const char c : e.text) {
            const size_t rgba = std::string_view("rgba").find(c);
            const char xyzw = rgba == std::string_view::npos ? c : "xyzw"[rgba];
            all += (all.empty() ? "" : ", ") + base + "." + xyzw;
        }
        return e.text.size() == 1 ? all : type(e.type) + "(" + all + ")";
    }

    std::string ternary(const Expression& e, int depth) const {
        const std::string condition = print(e.children[0], depth + 1), yes = print(e.children[1], depth + 1),
                          no = print(e.children[2], depth + 1);
        if (dialect_.names_before_types)
            return "select(" + no + "," + break_mark(depth) + yes + "," + break_mark(depth) + condition + ")";
        return condition + break_mark(depth) + "? " + yes + break_mark(depth) + ": " + no;
    }

    // vec3(x)
    static bool is_splat(const Expression& e) {
        return e.kind == Expression::Kind::call && e.children.size() == 1 && is_vector(e.type) &&
               e.children[0].type == Type::scalar && find_type(e.text);
    }

    std::string call(const Expression& e, int depth) const {
        const std::optional<Type> constructed = find_type(e.text);
        if (constructed && is_vector(*constructed) && e.children.size() == 1 && dialect_.splats_by_cast)
            return splat_by_cast(e, depth);
        const Function* function = constructed ? nullptr : find_function(e.text);
        if (function && function->name == "clamp" && dialect_.has_saturate && e.children[1].text == "0.0" &&
            e.children[2].text == "1.0")
            return "saturate(" + print(e.children[0], depth + 1) + ")";
        std::string text = constructed ? type(*constructed) : e.text;
        if (function && dialect_.renamed && !(function->*dialect_.renamed).empty())
            text = std::string(function->*dialect_.renamed);
        text += "(";
        // WGSL's mix takes a float for its third.
        const bool splats = function && function->shape == Shape::some_scalars && dialect_.splats_arguments &&
                            is_vector(e.type) && !(dialect_.names_before_types && function->name == "mix");
        const bool keeps_scalars = function && function->shape == Shape::some_scalars &&
                                   dialect_.converts_scalars &&
                                   std::ranges::any_of(e.children, [](const Expression& argument) {
                                       return is_vector(argument.type) && !is_splat(argument);
                                   });
        for (size_t i = 0; i < e.children.size(); ++i) {
            if (i) text += "," + break_mark(depth + 1);
            const Expression& child = e.children[i];
            const std::string argument =
                print(keeps_scalars && is_splat(child) ? child.children[0] : child, depth + 2);
            text +=
                splats && e.children[i].type == Type::scalar ? type(e.type) + "(" + argument + ")" : argument;
        }
        return text + ")";
    }

    // (float3)x; of a number as the language's programmers write it: float3(0.0, 0.0, 0.0).
    std::string splat_by_cast(const Expression& e, int depth) const {
        const Expression& value = e.children[0];
        const std::string text = print(value, depth + 1);
        if (value.kind == Expression::Kind::number) {
            std::string all = text;
            for (int i = 1; i < component_count(e.type); ++i) all += ", " + text;
            return type(e.type) + "(" + all + ")";
        }
        const bool simple = value.kind == Expression::Kind::name || value.kind == Expression::Kind::call;
        return "(" + type(e.type) + ")" + (simple ? text : "(" + text + ")");
    }

    const Dialect& dialect_;
};

// With break marks; `depth` is that of the outermost one.
std::string expression_text(const Expression& expression, const Dialect& dialect, int depth) {
    return ExpressionPrinter(dialect).print(expression, depth);
}

// Types and built-in functions as the language calls them: "vec3(0.0)", "mix(a, b, x)".
std::string comment_line(const std::string& line, const Dialect& dialect) {
    const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    std::string text;
    for (size_t i = 0; i < line.size();) {
        size_t end = i;
        while (end < line.size() && is_word(line[end])) ++end;
        const std::string word = line.substr(i, std::max<size_t>(end - i, 1));
        const std::optional<Type> type = find_type(word);
        const Function* function =
            dialect.renamed && end < line.size() && line[end] == '(' ? find_function(word) : nullptr;
        if (type && is_vector(*type))
            text += dialect.types[size_t(*type)];
        else
            text += function && !(function->*dialect.renamed).empty() ? function->*dialect.renamed : word;
        i += word.size();
    }
    return text;
}

std::string comment_text(const std::vector<std::string>& lines, size_t indent, const Dialect& dialect) {
    std::string text;
    for (const std::string& line : lines)
        text += std::string(indent, ' ') + (line.empty() ? "//" : "// " + comment_line(line, dialect)) + "\n";
    return text;
}

class StatementPrinter {
  public:
    explicit StatementPrinter(const Dialect& dialect) : dialect_(dialect) {}

    std::string item(const Item& item) {
        text_ = comment_text(item.comments.before, 0, dialect_);
        if (item.name.empty())
            declaration(item.constants[0], 0, true, item.comments.behind);
        else
            function(item);
        return std::move(text_);
    }

  private:
    std::string type(Type type) const { return std::string(dialect_.types[size_t(type)]); }
    std::string value(const Expression& e) const { return expression_text(e, dialect_, 0); }

    void line(const std::string& marked, size_t indent, const std::string& behind = {}) {
        text_ += wrap(marked, indent);
        if (behind.empty()) return;
        text_.pop_back();
        text_ += "  // " + comment_line(behind, dialect_) + "\n";
    }

    void function(const Item& item) {
        std::string head = std::string(dialect_.function_prefix);
        head += (dialect_.names_before_types ? "fn" : type(item.type)) + " " + item.name + "(";
        for (size_t i = 0; i < item.parameters.size(); ++i) {
            const Parameter& p = item.parameters[i];
            if (i) head += "," + break_mark(0);
            head += dialect_.names_before_types ? p.name + ": " + type(p.type) : type(p.type) + " " + p.name;
        }
        head += ")";
        if (dialect_.names_before_types) head += " -> " + type(item.type);
        line(head + " {", 0);
        block(item.body, kIndent);
        text_ += "}\n";
    }

    void block(const std::vector<Statement>& body, size_t indent) {
        for (const Statement& statement : body) {
            if (statement.comments.blank_line_before && &statement != &body.front()) text_ += "\n";
            text_ += comment_text(statement.comments.before, indent, dialect_);
            print(statement, indent);
        }
    }

    void print(const Statement& s, size_t indent) {
        switch (s.kind) {
            case Statement::Kind::declaration:
                return declaration(s, indent, false, s.comments.behind);
            case Statement::Kind::assignment: {
                const std::string step =
                    s.expressions.empty() ? s.operation : " " + s.operation + " " + value(s.expressions[0]);
                return line(s.target + step + ";", indent, s.comments.behind);
            }
            case Statement::Kind::return_value:
                return line("return " + value(s.expressions[0]) + ";", indent, s.comments.behind);
            case Statement::Kind::if_else:
                return if_else(s, indent);
            case Statement::Kind::for_loop:
                return for_loop(s, indent);
        }
    }

    void if_else(const Statement& s, size_t indent) {
        branch("if (" + value(s.expressions[0]) + ")", s.line, s.body, s.braces, indent, indent);
        if (s.otherwise.empty()) return;
        const bool same_line = s.braces || dialect_.names_before_types;
        if (same_line) text_.pop_back();
        const size_t else_indent = same_line ? 0 : indent;
        const bool chain =
            s.otherwise.size() == 1 && s.otherwise[0].kind == Statement::Kind::if_else && !s.else_braces;
        if (chain) {
            text_ += std::string(same_line ? 1 : else_indent, ' ') + "else ";
            const size_t start = text_.size();
            print(s.otherwise[0], indent);
            text_.erase(start, indent);
            return;
        }
        text_ += same_line ? " " : "";
        branch("else", s.otherwise[0].line, s.otherwise, s.else_braces, indent, else_indent);
    }

    void for_loop(const Statement& s, size_t indent) {
        const Declarator& counter = s.declarators[0];
        const std::string start = dialect_.names_before_types ? "var " : type(Type::integer) + " ";
        branch("for (" + start + counter.name + " = " + value(*counter.value) + "; " +
                   value(s.expressions[0]) + "; " +
                   (dialect_.names_before_types ? counter.name + "++" : "++" + counter.name) + ")",
               s.line, s.body, s.braces, indent, indent);
    }

    void branch(const std::string& head, int source_line, const std::vector<Statement>& body, bool braces,
                size_t indent, size_t head_indent) {
        const bool with_braces = braces || dialect_.names_before_types;
        // As the source has it: if (a < b) return c;
        if (!with_braces && body[0].line == source_line && body[0].comments.before.empty()) {
            const size_t start = text_.size() + head_indent;
            line(head, head_indent);
            text_.back() = ' ';
            const size_t statement = text_.size();
            print(body[0], 0);
            if (text_.size() - start <= kLineWidth && text_.find('\n', statement) == text_.size() - 1) return;
            text_.resize(start - head_indent);
        }
        line(head + (with_braces ? " {" : ""), head_indent);
        block(body, indent + kIndent);
        if (with_braces) text_ += std::string(indent, ' ') + "}\n";
    }

    void declaration(const Statement& s, size_t indent, bool global, const std::string& behind) {
        if (dialect_.names_before_types) {
            for (const Declarator& d : s.declarators)
                line(wgsl_declaration(s, d, global), indent, &d == &s.declarators.back() ? behind : "");
            return;
        }
        std::string text;
        if (s.constant) text = std::string(global ? dialect_.global_constant : "const") + " ";
        text += type(s.type) + " ";
        for (const Declarator& d : s.declarators) {
            if (&d != &s.declarators.front()) text += "," + break_mark(0);
            text += d.name;
            if (d.value) text += " = " + expression_text(*d.value, dialect_, 1);
        }
        line(text + ";", indent, behind);
    }

    // Types are deduced inside functions, and written where there is no value.
    std::string wgsl_declaration(const Statement& s, const Declarator& d, bool global) const {
        const std::string word = s.constant ? "const " : d.changes ? "var " : "let ";
        if (!d.value) return "var " + d.name + ": " + type(s.type) + ";";
        return word + d.name + (global ? ": " + type(s.type) : "") + " = " + value(*d.value) + ";";
    }

    const Dialect& dialect_;
    std::string text_;
};

}  // namespace

std::vector<std::string> call_lines(std::span<const Unit> units, Language language,
                                    std::span<const std::string> names) {
    const Dialect& dialect = dialect_of(language);
    std::vector<std::string> lines;
    for (const std::string& name : names)
        for (const Unit& unit : units)
            for (const Item& item : unit.items) {
                if (item.name != name) continue;
                std::string arguments;
                for (const Parameter& parameter : item.parameters)
                    arguments += (arguments.empty() ? "" : ", ") + parameter.name;
                const std::string_view type =
                    dialect.names_before_types ? "let" : dialect.types[size_t(item.type)];
                lines.push_back(std::string(type) + " " + name.substr(name.find('_') + 1) + " = " + name +
                                "(" + arguments + ");");
            }
    return lines;
}

std::string print(std::span<const Unit> units, Language language, std::span<const std::string> heading) {
    const Dialect& dialect = dialect_of(language);
    std::string text = comment_text({heading.begin(), heading.end()}, 0, dialect);
    text += dialect.opening;
    if (language == Language::cpp) text += cpp_prelude();
    for (const Unit& unit : units) {
        if (!unit.header.empty()) text += "\n" + comment_text(unit.header, 0, dialect);
        bool constant_before = false;
        for (const Item& item : unit.items) {
            const bool constant = item.name.empty();
            if (!(constant && constant_before && item.comments.before.empty())) text += "\n";
            text += StatementPrinter(dialect).item(item);
            constant_before = constant;
        }
    }
    if (!dialect.closing.empty()) text += "\n" + std::string(dialect.closing);
    return text;
}

}  // namespace dermis::shading
