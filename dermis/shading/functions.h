#pragma once
// The built-in functions of the subset: what GLSL has and every other language too, if under another name.

#include <optional>
#include <string_view>

#include "dermis/shading/syntax.h"

namespace dermis::shading {

/// How the arguments' types give the result's.
enum class Shape {
    same,          ///< all arguments have the result's type
    some_scalars,  ///< the same, or a vector's arguments may be float: max(v, 0.0)
    to_scalar,     ///< vectors of one type to float: dot, length
    vec3_only      ///< cross
};

struct Function {
    std::string_view name;
    int arguments = 1;
    Shape shape = Shape::same;
    std::string_view hlsl = {}, msl = {}, wgsl = {};  ///< empty: the same name
};

/// Null when there is none.
[[nodiscard]] const Function* find_function(std::string_view name);

}  // namespace dermis::shading
