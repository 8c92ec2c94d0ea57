#include "dermis/shading/syntax.h"

#include <array>

namespace dermis::shading {
namespace {

constexpr std::array<std::string_view, 6> kTypeNames = {"bool", "int", "float", "vec2", "vec3", "vec4"};

}  // namespace

std::string_view type_name(Type type) {
    return kTypeNames[size_t(type)];
}

std::optional<Type> find_type(std::string_view name) {
    for (size_t i = 0; i < kTypeNames.size(); ++i)
        if (kTypeNames[i] == name) return Type(i);
    return {};
}

int component_count(Type type) {
    return is_vector(type) ? int(type) - int(Type::vec2) + 2 : 1;
}

Type float_type(int components) {
    return components == 1 ? Type::scalar : Type(int(Type::vec2) + components - 2);
}

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
