#pragma once
// The skin's shading functions as a tree: what the parser makes of the GLSL in shaders/include/skin, and what
// the printers read. The subset has functions and constants of float, vec2, vec3, vec4, int and bool; if,
// for over a counter and return; operators, the ternary, calls and swizzles. It has no overloading, `out`
// parameters, assignment to a parameter or to several components at once, structures, arrays, matrices or
// textures. Comments belong to what follows them.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dermis::shading {

enum class Type { boolean, integer, scalar, vec2, vec3, vec4 };

/// "float", "vec3": as GLSL has it.
[[nodiscard]] std::string_view type_name(Type type);
[[nodiscard]] std::optional<Type> find_type(std::string_view name);
[[nodiscard]] inline bool is_vector(Type type) {
    return type >= Type::vec2;
}
/// 1 to 4.
[[nodiscard]] int component_count(Type type);
/// The float type of 1 to 4 components.
[[nodiscard]] Type float_type(int components);

/// `text` is the literal, name, operator, function or components; a constructor is a call named like its
/// type.
struct Expression {
    enum class Kind { number, name, unary, binary, ternary, call, swizzle, parentheses };
    Kind kind = Kind::number;
    std::string text = {};
    std::vector<Expression> children = {};
    int line = 0;
    Type type = Type::scalar;  ///< set by check()
};

struct Declarator {
    std::string name;
    std::optional<Expression> value = {};
    bool changes = false;  ///< assigned to after its declaration; set by check()
};

struct Comments {
    std::vector<std::string> before = {};  ///< lines without "//" and the space behind it
    std::string behind = {};               ///< on the same line
    bool blank_line_before = false;
};

struct Statement {
    enum class Kind { declaration, assignment, if_else, for_loop, return_value };
    Kind kind = Kind::return_value;
    int line = 0;
    Comments comments = {};
    bool constant = false;                     ///< declaration
    Type type = Type::scalar;                  ///< declaration
    std::vector<Declarator> declarators = {};  ///< declaration; the counter of a loop
    std::string target = {},
                operation = {};  ///< assignment: a variable or one component of it, and "=", "+=", ...
    std::vector<Expression> expressions = {};  ///< one: value or condition
    std::vector<Statement> body = {}, otherwise = {};
    bool braces = false, else_braces = false;  ///< as the source has them
};

struct Parameter {
    Type type = Type::scalar;
    std::string name;
};

/// A function, or constants when `name` is empty: `constants` then holds one declaration.
struct Item {
    std::string name = {};
    int line = 0;
    Comments comments = {};
    Type type = Type::scalar;
    std::vector<Parameter> parameters = {};
    std::vector<Statement> body = {}, constants = {};
};

/// One file.
struct Unit {
    std::string path;
    std::vector<std::string> header = {};    ///< the comment at the head of the file
    std::vector<std::string> includes = {};  ///< paths, as written
    std::vector<Item> items = {};
};

/// How the arguments' types give the result's.
enum class Shape {
    same,          ///< all arguments have the result's type
    some_scalars,  ///< the same, or a vector's arguments may be float: max(v, 0.0)
    to_scalar,     ///< vectors of one type to float: dot, length
    vec3_only      ///< cross
};

/// A built-in function: what GLSL has and every other language too, if under another name.
struct Function {
    std::string_view name;
    int arguments = 1;
    Shape shape = Shape::same;
    std::string_view hlsl = {}, msl = {}, wgsl = {};  ///< empty: the same name
};

/// Null when there is none.
[[nodiscard]] const Function* find_function(std::string_view name);

}  // namespace dermis::shading
