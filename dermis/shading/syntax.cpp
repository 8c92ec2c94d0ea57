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

}  // namespace dermis::shading
