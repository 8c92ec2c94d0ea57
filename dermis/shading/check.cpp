#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>

#include "dermis/base/text.h"
#include "dermis/shading/lexer.h"
#include "dermis/shading/parser.h"
#include "dermis/shading/syntax.h"

namespace dermis::shading {
namespace {

// Words that a source must not use as names, as one of the languages has them for itself.
struct Reserved {
    std::string_view language;
    std::string_view words;  // separated by spaces, one before and behind each
};

// The types of the subset, keywords, and functions and macros that a name of ours would hide or run into.
constexpr std::array<Reserved, 6> kReserved = {{
    {"GLSL",
     " attribute buffer centroid coherent common const cast discard double enum extern external filter fixed "
     "flat "
     "goto half highp image input inline inout interface invariant layout long lowp mat2 mat3 mat4 mediump "
     "namespace noinline noperspective output packed partition patch precise precision public readonly "
     "resource "
     "restrict sample sampler shared short sizeof smooth static struct subroutine superp switch template "
     "texture this "
     "typedef uniform union unsigned using varying void volatile while writeonly "},
    {"HLSL",
     " asm column_major compile dword export float1 float2 float3 float4 frac groupshared half in lerp line "
     "linear matrix min10float min16float nointerpolation out pass pixelfragment point register row_major "
     "rsqrt saturate snorm stateblock string tbuffer technique texture2D triangle unorm vector "
     "vertexfragment "},
    {"MSL", " constant device fragment kernel metal saturate thread threadgroup vertex ushort uint uchar "},
    {"WGSL",
     " alias as async auto await become case crate debugger default delete diagnostic do dyn enable explicit "
     "fallthrough "
     "final fn from get global handle impl let loop macro match meta mod module move mut mutable native new "
     "nil null "
     "override package private proc ptr ref require self set spec storage super target trait try type unless "
     "unsafe use var vec virtual where with workgroup yield f32 i32 u32 vec2f vec3f vec4f select "},
    {"gdshader",
     " group_uniforms hint_range instance light fragment render_mode repeat_enable shader_type source_color "
     "start stencil_mode "
     "PI TAU E TIME UV ALBEDO NORMAL "},
    {"C++",
     " alignas alignof and and_eq asm bitand bitor catch char class compl concept consteval constexpr "
     "constinit "
     "co_await decltype explicit far float friend mutable near noexcept not nullptr operator or protected "
     "register requires signed static_assert std throw typeid typename wchar_t xor small y0 y1 j0 j1 "},
}};

// The language that reserves this name; empty when none does.
std::string_view reserved_by(std::string_view name) {
    const std::string padded = " " + std::string(name) + " ";
    for (const Reserved& reserved : kReserved)
        if (reserved.words.find(padded) != std::string_view::npos) return reserved.language;
    return {};
}

struct Variable {
    Type type = Type::scalar;
    bool assignable = false;
    Declarator* declarator = nullptr;
};

struct Signature {
    Type result = Type::scalar;
    std::vector<Type> arguments;
};

class Checker {
  public:
    Result<void> run(std::vector<Unit>& units) {
        for (Unit& unit : units) {
            path_ = unit.path;
            for (Item& item : unit.items)
                if (item.name.empty())
                    declare(item.constants[0]);
                else
                    check_function(item);
            if (error_) return *error_;
        }
        return {};
    }

  private:
    void fail(int line, const std::string& what) {
        if (!error_) error_ = error_at(path_, line, what);
    }

    void check_new_name(int line, const std::string& name) {
        if (const std::string_view language = reserved_by(name); !language.empty())
            fail(line, "'" + name + "' is a word of " + std::string(language) + "; choose another name");
        if (find_function(name) || find_type(name))
            fail(line, "'" + name + "' is built in; choose another name");
        if (variables_.contains(name) || functions_.contains(name))
            fail(line, "'" + name + "' is defined twice; WGSL has no overloading: choose another name");
    }

    void check_function(Item& item) {
        check_new_name(item.line, item.name);
        const auto outer = variables_;
        Signature signature{.result = item.type, .arguments = {}};
        for (const Parameter& parameter : item.parameters) {
            check_new_name(item.line, parameter.name);
            variables_[parameter.name] = {parameter.type, false, nullptr};
            signature.arguments.push_back(parameter.type);
        }
        function_ = &item;
        check_statements(item.body);
        if (!always_returns(item.body))
            fail(item.line, "'" + item.name + "' can end without a return; add one");
        variables_ = outer;
        functions_[item.name] = signature;
    }

    static bool always_returns(const std::vector<Statement>& body) {
        if (body.empty()) return false;
        const Statement& last = body.back();
        if (last.kind == Statement::Kind::return_value) return true;
        return last.kind == Statement::Kind::if_else && always_returns(last.body) &&
               always_returns(last.otherwise);
    }

    void check_statements(std::vector<Statement>& body) {
        const auto outer = variables_;
        for (Statement& statement : body) check_statement(statement);
        variables_ = outer;
    }

    void check_statement(Statement& statement) {
        switch (statement.kind) {
            case Statement::Kind::declaration:
                return declare(statement);
            case Statement::Kind::assignment:
                return check_assignment(statement);
            case Statement::Kind::if_else:
                want(statement.expressions[0], Type::boolean, "a condition");
                check_statements(statement.body);
                return check_statements(statement.otherwise);
            case Statement::Kind::for_loop:
                return check_loop(statement);
            case Statement::Kind::return_value:
                return want(statement.expressions[0], function_->type,
                            "what '" + function_->name + "' returns");
        }
    }

    void check_loop(Statement& statement) {
        const auto outer = variables_;
        Declarator& counter = statement.declarators[0];
        want(*counter.value, Type::integer, "the counter's start");
        check_new_name(statement.line, counter.name);
        variables_[counter.name] = {Type::integer, false, nullptr};
        want(statement.expressions[0], Type::boolean, "the loop's condition");
        check_statements(statement.body);
        variables_ = outer;
    }

    void declare(Statement& statement) {
        for (Declarator& declarator : statement.declarators) {
            check_new_name(statement.line, declarator.name);
            if (declarator.value)
                want(*declarator.value, statement.type, "the value of '" + declarator.name + "'");
            variables_[declarator.name] = {statement.type, !statement.constant, &declarator};
        }
    }

    void check_assignment(Statement& statement) {
        const size_t dot = statement.target.find('.');
        const std::string name = statement.target.substr(0, dot);
        const auto found = variables_.find(name);
        if (found == variables_.end()) return unknown(statement.line, name);
        if (!found->second.assignable)
            return fail(statement.line,
                        "'" + name +
                            "' is a parameter, a counter or a constant, which WGSL does not assign "
                            "to; copy it to a variable");
        found->second.declarator->changes = true;
        Type type = found->second.type;
        if (dot != std::string::npos) {
            if (statement.target.size() != dot + 2)
                return fail(statement.line, "an assignment to several components; assign the whole vector");
            type = Type::scalar;
        }
        if (statement.expressions.empty()) return;
        Expression& value = statement.expressions[0];
        const Type given = type_of(value);
        const bool scales = is_vector(type) && given == Type::scalar &&
                            (statement.operation == "*=" || statement.operation == "/=");
        if (given != type && !scales) mismatch(value.line, "what '" + name + "' is assigned", type, given);
    }

    void unknown(int line, const std::string& name) {
        std::vector<std::string> names;
        for (const auto& [known, variable] : variables_) names.push_back(known);
        for (const auto& [known, signature] : functions_) names.push_back(known);
        fail(line, unknown_name("name", name, names));
    }

    void mismatch(int line, const std::string& what, Type wanted, Type given) {
        fail(line, what + " is " + std::string(type_name(given)) + ", not " + std::string(type_name(wanted)) +
                       "; convert it, or write a number with a point");
    }

    void want(Expression& expression, Type wanted, const std::string& what) {
        const Type given = type_of(expression);
        if (given != wanted) mismatch(expression.line, what, wanted, given);
    }

    Type type_of(Expression& e) {
        for (Expression& child : e.children) type_of(child);
        if (error_) return e.type;
        switch (e.kind) {
            case Expression::Kind::number:
                e.type = e.text.find_first_of(".eE") == std::string::npos ? Type::integer : Type::scalar;
                break;
            case Expression::Kind::name:
                e.type = type_of_name(e);
                break;
            case Expression::Kind::parentheses:
                e.type = e.children[0].type;
                break;
            case Expression::Kind::unary:
                e.type = e.children[0].type;
                if ((e.text == "!") != (e.type == Type::boolean))
                    fail(e.line, "'" + e.text + "' before " + std::string(type_name(e.type)));
                break;
            case Expression::Kind::binary:
                e.type = type_of_binary(e);
                break;
            case Expression::Kind::ternary:
                if (e.children[0].type != Type::boolean)
                    mismatch(e.line, "a condition", Type::boolean, e.children[0].type);
                e.type = e.children[1].type;
                if (e.children[2].type != e.type)
                    mismatch(e.line, "the second value of ? :", e.type, e.children[2].type);
                break;
            case Expression::Kind::call:
                e.type = type_of_call(e);
                break;
            case Expression::Kind::swizzle:
                e.type = type_of_swizzle(e);
                break;
        }
        return e.type;
    }

    Type type_of_name(const Expression& e) {
        if (e.text == "true" || e.text == "false") return Type::boolean;
        const auto found = variables_.find(e.text);
        if (found != variables_.end()) return found->second.type;
        unknown(e.line, e.text);
        return Type::scalar;
    }

    Type type_of_binary(const Expression& e) {
        const Type left = e.children[0].type, right = e.children[1].type;
        const bool logical = e.text == "&&" || e.text == "||";
        const bool compares = e.text == "==" || e.text == "!=" || e.text[0] == '<' || e.text[0] == '>';
        const bool scales = !compares && ((is_vector(left) && right == Type::scalar) ||
                                          (is_vector(right) && left == Type::scalar));
        if (logical != (left == Type::boolean) || (left != right && !scales) || (compares && is_vector(left)))
            fail(e.line, std::string(type_name(left)) + " " + e.text + " " + std::string(type_name(right)) +
                             " is not of the subset; convert one of them, or write numbers with a point");
        if (logical || compares) return Type::boolean;
        return is_vector(left) ? left : right;
    }

    Type type_of_swizzle(const Expression& e) {
        const Type from = e.children[0].type;
        for (const char c : e.text) {
            const size_t xyzw = std::string_view("xyzw").find(c), rgba = std::string_view("rgba").find(c);
            const size_t component = std::min(xyzw, rgba);
            if (!is_vector(from) || e.text.size() > 4 || component >= size_t(component_count(from))) {
                fail(e.line, "'." + e.text + "' of " + std::string(type_name(from)));
                return Type::scalar;
            }
        }
        return float_type(int(e.text.size()));
    }

    Type type_of_call(Expression& e) {
        if (const std::optional<Type> type = find_type(e.text)) return type_of_constructor(e, *type);
        if (const Function* function = find_function(e.text)) return type_of_built_in(e, *function);
        const auto found = functions_.find(e.text);
        if (found == functions_.end()) {
            unknown(e.line, e.text);
            return Type::scalar;
        }
        const Signature& signature = found->second;
        if (signature.arguments.size() != e.children.size())
            fail(e.line, fmt::format("'{}' gets {} arguments; it has {}", e.text, e.children.size(),
                                     signature.arguments.size()));
        for (size_t i = 0; i < std::min(e.children.size(), signature.arguments.size()); ++i)
            if (e.children[i].type != signature.arguments[i])
                mismatch(e.line, fmt::format("argument {} of '{}'", i + 1, e.text), signature.arguments[i],
                         e.children[i].type);
        return signature.result;
    }

    Type type_of_constructor(const Expression& e, Type type) {
        int given = 0;
        bool floats = true;
        for (const Expression& child : e.children) {
            given += component_count(child.type);
            floats &= child.type >= Type::scalar;
        }
        const bool splat = is_vector(type) && e.children.size() == 1 && e.children[0].type == Type::scalar;
        if (is_vector(type) ? !floats || (!splat && given != component_count(type)) : e.children.size() != 1)
            fail(e.line,
                 fmt::format("'{}' of {} components; give one float, or as many as it has", e.text, given));
        return type;
    }

    Type type_of_built_in(const Expression& e, const Function& function) {
        Type widest = Type::scalar;
        if (int(e.children.size()) != function.arguments) {
            fail(e.line, fmt::format("'{}' gets {} arguments; it has {}", e.text, e.children.size(),
                                     function.arguments));
            return widest;
        }
        for (const Expression& child : e.children) widest = std::max(widest, child.type);
        for (const Expression& child : e.children) {
            const bool fits =
                child.type == widest || (function.shape == Shape::some_scalars && child.type == Type::scalar);
            if (!fits || child.type < Type::scalar)
                mismatch(e.line, "an argument of '" + e.text + "'", widest, child.type);
        }
        if (function.shape == Shape::vec3_only && widest != Type::vec3)
            mismatch(e.line, "an argument of '" + e.text + "'", Type::vec3, widest);
        return function.shape == Shape::to_scalar ? Type::scalar : widest;
    }

    std::string path_;
    std::map<std::string, Variable> variables_;
    std::map<std::string, Signature> functions_;
    const Item* function_ = nullptr;
    std::optional<Error> error_;
};

}  // namespace

Result<void> check(std::vector<Unit>& units) {
    return Checker().run(units);
}

}  // namespace dermis::shading
