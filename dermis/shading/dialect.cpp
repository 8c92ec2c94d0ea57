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
                           .splats_arguments = true};
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

// Templates over V, so that one text serves float2, float3 and float4.
std::string_view cpp_prelude() {
    return R"dermis_text(
// Vectors of floats and the shading languages' functions of them.
struct float2 {
    float x = 0, y = 0;
    static constexpr int size = 2;
    constexpr float2() = default;
    constexpr explicit float2(float s) : x(s), y(s) {}
    constexpr float2(float x_, float y_) : x(x_), y(y_) {}
    constexpr float& operator[](int i) { return i == 0 ? x : y; }
    constexpr float operator[](int i) const { return i == 0 ? x : y; }
};

struct float3 {
    float x = 0, y = 0, z = 0;
    static constexpr int size = 3;
    constexpr float3() = default;
    constexpr explicit float3(float s) : x(s), y(s), z(s) {}
    constexpr float3(float x_, float y_, float z_) : x(x_), y(y_), z(z_) {}
    constexpr float3(float x_, float2 yz) : x(x_), y(yz.x), z(yz.y) {}
    constexpr float3(float2 xy, float z_) : x(xy.x), y(xy.y), z(z_) {}
    constexpr float& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
    constexpr float operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
};

struct float4 {
    float x = 0, y = 0, z = 0, w = 0;
    static constexpr int size = 4;
    constexpr float4() = default;
    constexpr explicit float4(float s) : x(s), y(s), z(s), w(s) {}
    constexpr float4(float x_, float y_, float z_, float w_) : x(x_), y(y_), z(z_), w(w_) {}
    constexpr float4(float3 xyz, float w_) : x(xyz.x), y(xyz.y), z(xyz.z), w(w_) {}
    constexpr float& operator[](int i) { return i == 0 ? x : i == 1 ? y : i == 2 ? z : w; }
    constexpr float operator[](int i) const { return i == 0 ? x : i == 1 ? y : i == 2 ? z : w; }
};

// A function of floats, applied to each component; a float argument counts for all of them.
constexpr float component(float s, int) { return s; }
template <class V, int = V::size> constexpr float component(V v, int i) { return v[i]; }
template <class V, class F, class... A> constexpr V each(F f, A... a) {
    V v;
    for (int i = 0; i < V::size; ++i) v[i] = f(component(a, i)...);
    return v;
}
constexpr float sum_of(float a, float b) { return a + b; }
constexpr float difference_of(float a, float b) { return a - b; }
constexpr float product_of(float a, float b) { return a * b; }
constexpr float quotient_of(float a, float b) { return a / b; }
template <class V, int = V::size> constexpr V operator-(V a) { return each<V>(difference_of, 0.0f, a); }
template <class V, int = V::size> constexpr V operator+(V a, V b) { return each<V>(sum_of, a, b); }
template <class V, int = V::size> constexpr V operator+(V a, float b) { return each<V>(sum_of, a, b); }
template <class V, int = V::size> constexpr V operator+(float a, V b) { return each<V>(sum_of, a, b); }
template <class V, int = V::size> constexpr V operator-(V a, V b) { return each<V>(difference_of, a, b); }
template <class V, int = V::size> constexpr V operator-(V a, float b) { return each<V>(difference_of, a, b); }
template <class V, int = V::size> constexpr V operator-(float a, V b) { return each<V>(difference_of, a, b); }
template <class V, int = V::size> constexpr V operator*(V a, V b) { return each<V>(product_of, a, b); }
template <class V, int = V::size> constexpr V operator*(V a, float b) { return each<V>(product_of, a, b); }
template <class V, int = V::size> constexpr V operator*(float a, V b) { return each<V>(product_of, a, b); }
template <class V, int = V::size> constexpr V operator/(V a, V b) { return each<V>(quotient_of, a, b); }
template <class V, int = V::size> constexpr V operator/(V a, float b) { return each<V>(quotient_of, a, b); }
template <class V, int = V::size> constexpr V operator/(float a, V b) { return each<V>(quotient_of, a, b); }
template <class V, class B, int = V::size> constexpr V& operator+=(V& a, B b) { return a = a + b; }
template <class V, class B, int = V::size> constexpr V& operator-=(V& a, B b) { return a = a - b; }
template <class V, class B, int = V::size> constexpr V& operator*=(V& a, B b) { return a = a * b; }
template <class V, class B, int = V::size> constexpr V& operator/=(V& a, B b) { return a = a / b; }

using std::abs, std::acos, std::cos, std::exp, std::exp2, std::floor, std::log, std::log2, std::pow, std::sin, std::sqrt;
inline float min(float a, float b) { return b < a ? b : a; }
inline float max(float a, float b) { return a < b ? b : a; }
inline float clamp(float x, float a, float b) { return min(max(x, a), b); }
inline float mix(float a, float b, float t) { return a * (1.0f - t) + b * t; }
inline float step(float edge, float x) { return x < edge ? 0.0f : 1.0f; }
inline float sign(float x) { return x > 0.0f ? 1.0f : x < 0.0f ? -1.0f : 0.0f; }
inline float fract(float x) { return x - floor(x); }
inline float inversesqrt(float x) { return 1.0f / sqrt(x); }
inline float smoothstep(float a, float b, float x) {
    float t = clamp((x - a) / (b - a), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}
template <class V, int = V::size> V abs(V v) { return each<V>([](float x) { return abs(x); }, v); }
template <class V, int = V::size> V acos(V v) { return each<V>([](float x) { return acos(x); }, v); }
template <class V, int = V::size> V cos(V v) { return each<V>([](float x) { return cos(x); }, v); }
template <class V, int = V::size> V exp(V v) { return each<V>([](float x) { return exp(x); }, v); }
template <class V, int = V::size> V exp2(V v) { return each<V>([](float x) { return exp2(x); }, v); }
template <class V, int = V::size> V floor(V v) { return each<V>([](float x) { return floor(x); }, v); }
template <class V, int = V::size> V fract(V v) { return each<V>([](float x) { return fract(x); }, v); }
template <class V, int = V::size> V inversesqrt(V v) { return each<V>([](float x) { return inversesqrt(x); }, v); }
template <class V, int = V::size> V log(V v) { return each<V>([](float x) { return log(x); }, v); }
template <class V, int = V::size> V log2(V v) { return each<V>([](float x) { return log2(x); }, v); }
template <class V, int = V::size> V sign(V v) { return each<V>([](float x) { return sign(x); }, v); }
template <class V, int = V::size> V sin(V v) { return each<V>([](float x) { return sin(x); }, v); }
template <class V, int = V::size> V sqrt(V v) { return each<V>([](float x) { return sqrt(x); }, v); }
template <class V, int = V::size> V pow(V a, V b) {
    return each<V>([](float x, float y) { return pow(x, y); }, a, b);
}
template <class V, class S, int = V::size> V min(V a, S b) {
    return each<V>([](float x, float y) { return min(x, y); }, a, b);
}
template <class V, class S, int = V::size> V max(V a, S b) {
    return each<V>([](float x, float y) { return max(x, y); }, a, b);
}
template <class V, class S, int = V::size> V step(S a, V b) {
    return each<V>([](float x, float y) { return step(x, y); }, a, b);
}
template <class V, class A, class B, int = V::size> V clamp(V v, A a, B b) { return min(max(v, a), b); }
template <class V, class S, int = V::size> V mix(V a, V b, S t) { return a * (1.0f - t) + b * t; }
template <class V, class S, int = V::size> V smoothstep(S a, S b, V v) {
    return each<V>([](float p, float q, float x) { return smoothstep(p, q, x); }, a, b, v);
}
template <class V, int = V::size> float dot(V a, V b) {
    float sum = 0.0f;
    for (int i = 0; i < V::size; ++i) sum += a[i] * b[i];
    return sum;
}
template <class V, int = V::size> float length(V v) { return sqrt(dot(v, v)); }
template <class V, int = V::size> float distance(V a, V b) { return length(a - b); }
template <class V, int = V::size> V normalize(V v) { return v * (1.0f / length(v)); }
template <class V, int = V::size> V reflect(V i, V n) { return i - 2.0f * dot(n, i) * n; }
inline float3 cross(float3 a, float3 b) {
    return float3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
)dermis_text";
}

}  // namespace dermis::shading
