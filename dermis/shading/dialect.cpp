#include "dermis/shading/dialect.h"

#include "dermis/base/text.h"

namespace dermis::shading {
namespace {

constexpr std::array<std::string_view, 6> kGlslTypes = {"bool", "int", "float", "vec2", "vec3", "vec4"},
                                          kFloat3Types = {"bool",   "int",    "float",
                                                          "float2", "float3", "float4"},
                                          kWgslTypes = {"bool", "i32", "f32", "vec2f", "vec3f", "vec4f"};

constexpr std::string_view kGuardOpening = "#ifndef DERMIS_SKIN\n#define DERMIS_SKIN\n";
constexpr std::string_view kGuardClosing = "#endif\n";

constexpr Dialect kGlsl = {.name = "glsl",
                           .extension = ".glsl",
                           .types = kGlslTypes,
                           .opening = kGuardOpening,
                           .closing = kGuardClosing};
constexpr Dialect kEssl = {.name = "essl",
                           .extension = ".essl",
                           .types = kGlslTypes,
                           .opening = "#ifndef DERMIS_SKIN\n#define DERMIS_SKIN\nprecision highp float;\n",
                           .closing = kGuardClosing};
constexpr Dialect kHlsl = {.name = "hlsl",
                           .extension = ".hlsl",
                           .types = kFloat3Types,
                           .global_constant = "static const",
                           .renamed = &Function::hlsl,
                           .splats_by_cast = true,
                           .converts_scalars = true,
                           .has_saturate = true,
                           .opening = kGuardOpening,
                           .closing = kGuardClosing};
constexpr Dialect kMsl = {
    .name = "msl",
    .extension = ".metal",
    .types = kFloat3Types,
    .global_constant = "constant",
    .function_prefix = "inline ",
    .renamed = &Function::msl,
    .splats_arguments = true,
    .has_saturate = true,
    .opening = "#pragma once\n\n#include <metal_stdlib>\n\nnamespace skin {\n\nusing namespace metal;\n",
    .closing = "}  // namespace skin\n"};
constexpr Dialect kWgsl = {.name = "wgsl",
                           .extension = ".wgsl",
                           .types = kWgslTypes,
                           .renamed = &Function::wgsl,
                           .names_before_types = true,
                           .splats_arguments = true,
                           .has_saturate = true};
constexpr Dialect kGdshader = {.name = "gdshader",
                               .extension = ".gdshaderinc",
                               .types = kGlslTypes,
                               .opening = kGuardOpening,
                               .closing = kGuardClosing};
constexpr Dialect kCpp = {.name = "cpp",
                          .extension = ".h",
                          .types = kFloat3Types,
                          .global_constant = "constexpr",
                          .function_prefix = "inline ",
                          .number_suffix = "f",
                          .spells_swizzles = true,
                          .opening = "#pragma once\n\n#include <cmath>\n\nnamespace skin {\n",
                          .closing = "}  // namespace skin\n"};

constexpr std::array<const Dialect*, 7> kDialects = {&kGlsl, &kEssl,     &kHlsl, &kMsl,
                                                     &kWgsl, &kGdshader, &kCpp};

}  // namespace

const Dialect& dialect_of(Language language) {
    return *kDialects[size_t(language)];
}

std::vector<std::string> language_names() {
    std::vector<std::string> names;
    for (const Dialect* dialect : kDialects) names.emplace_back(dialect->name);
    return names;
}

Result<Language> find_language(std::string_view name) {
    for (size_t i = 0; i < kDialects.size(); ++i)
        if (kDialects[i]->name == name) return Language(i);
    return Error{unknown_name("language", name, language_names())};
}

std::string_view language_name(Language language) {
    return dialect_of(language).name;
}

std::string_view file_extension(Language language) {
    return dialect_of(language).extension;
}

}  // namespace dermis::shading
