#include "dermis/shading/printer.h"

namespace dermis::shading {
namespace {

constexpr size_t kIndent = 4;

class StatementPrinter {
  public:
    explicit StatementPrinter(const Dialect& dialect) : dialect_(dialect) {}

    std::string item(const Item& item) {
        text_ = comment_text(item.comments.before, 0);
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
        text_ += "  // " + behind + "\n";
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
            text_ += comment_text(statement.comments.before, indent);
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

std::string comment_text(const std::vector<std::string>& lines, size_t indent) {
    std::string text;
    for (const std::string& line : lines)
        text += std::string(indent, ' ') + (line.empty() ? "//" : "// " + line) + "\n";
    return text;
}

std::string item_text(const Item& item, const Dialect& dialect) {
    return StatementPrinter(dialect).item(item);
}

std::string print(std::span<const Unit> units, Language language, std::span<const std::string> heading) {
    const Dialect& dialect = dialect_of(language);
    std::string text = comment_text({heading.begin(), heading.end()}, 0);
    text += dialect.opening;
    if (language == Language::cpp) text += cpp_prelude();
    for (const Unit& unit : units) {
        if (!unit.header.empty()) text += "\n" + comment_text(unit.header, 0);
        bool constant_before = false;
        for (const Item& item : unit.items) {
            const bool constant = item.name.empty();
            if (!(constant && constant_before && item.comments.before.empty())) text += "\n";
            text += item_text(item, dialect);
            constant_before = constant;
        }
    }
    if (!dialect.closing.empty()) text += "\n" + std::string(dialect.closing);
    return text;
}

}  // namespace dermis::shading
