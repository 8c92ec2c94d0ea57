// Words that a source must not use as names, as one of the languages has them for itself.

#include <array>
#include <span>

#include "dermis/shading/check.h"

namespace dermis::shading {
namespace {

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

}  // namespace

std::string_view reserved_by(std::string_view name) {
    const std::string padded = " " + std::string(name) + " ";
    for (const Reserved& reserved : kReserved)
        if (reserved.words.find(padded) != std::string_view::npos) return reserved.language;
    return {};
}

}  // namespace dermis::shading
