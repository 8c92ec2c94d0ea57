#pragma once
// The differences between the languages, as data for one printer.

#include <array>
#include <string_view>

#include "dermis/shading/shading.h"
#include "dermis/shading/syntax.h"

namespace dermis::shading {

struct Dialect {
    std::string_view name, extension;
    std::array<std::string_view, 6> types;          ///< in the order of Type
    std::string_view global_constant = "const";     ///< before a constant outside functions
    std::string_view function_prefix = {};          ///< "inline "
    std::string_view number_suffix = {};            ///< of float literals
    std::string_view Function::*renamed = nullptr;  ///< which column of the functions' names
    bool names_before_types = false;  ///< fn f(x: f32) -> f32, let and var, select, braces everywhere
    bool splats_arguments = false;    ///< max(v, vec3f(0.0)): all arguments of one type
    bool splats_by_cast = false;      ///< (float3)x, as float3(x) does not exist
    bool converts_scalars = false;    ///< min(v, 0.5) and lerp(0.25, v, w), as a scalar counts for all
    bool spells_swizzles = false;     ///< float2(v.x, v.y), as v.xy does not exist
    bool has_saturate = false;        ///< of vectors too; Babylon.js hides WGSL's with one of a float
    std::string_view opening = {}, closing = {};  ///< around the functions
};

[[nodiscard]] const Dialect& dialect_of(Language language);

/// Vectors and the built-in functions for the C++ header.
[[nodiscard]] std::string_view cpp_prelude();

}  // namespace dermis::shading
