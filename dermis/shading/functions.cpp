#include "dermis/shading/functions.h"

#include <array>

namespace dermis::shading {
namespace {

constexpr std::array<Function, 26> kFunctions = {{
    {"abs"},
    {"acos"},
    {"clamp", 3, Shape::some_scalars},
    {"cos"},
    {"cross", 2, Shape::vec3_only},
    {"distance", 2, Shape::to_scalar},
    {"dot", 2, Shape::to_scalar},
    {"exp"},
    {"exp2"},
    {"floor"},
    {"fract", 1, Shape::same, "frac"},
    {"inversesqrt", 1, Shape::same, "rsqrt", "rsqrt", "inverseSqrt"},
    {"length", 1, Shape::to_scalar},
    {"log"},
    {"log2"},
    {"max", 2, Shape::some_scalars},
    {"min", 2, Shape::some_scalars},
    {"mix", 3, Shape::some_scalars, "lerp"},
    {"normalize"},
    {"pow", 2},
    {"reflect", 2},
    {"sign"},
    {"sin"},
    {"smoothstep", 3, Shape::some_scalars},
    {"sqrt"},
    {"step", 2, Shape::some_scalars},
}};

}  // namespace

const Function* find_function(std::string_view name) {
    for (const Function& function : kFunctions)
        if (function.name == name) return &function;
    return nullptr;
}

}  // namespace dermis::shading
