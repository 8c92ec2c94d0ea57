#include <algorithm>

#include "dermis/shading/printer.h"

namespace dermis::shading {
namespace {

constexpr unsigned char kFirstMark = 0x80;
constexpr int kDeepest = 0x7F;

bool is_mark(char c) {
    return static_cast<unsigned char>(c) >= kFirstMark;
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

}  // namespace

std::string break_mark(int depth) {
    return {char(kFirstMark + static_cast<unsigned char>(std::min(depth, kDeepest)))};
}

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

std::string expression_text(const Expression& expression, const Dialect& dialect, int depth) {
    return ExpressionPrinter(dialect).print(expression, depth);
}

}  // namespace dermis::shading
