// The vertex of every geometry pass; the domains differ only in where they put gl_Position.
#extension GL_GOOGLE_include_directive : require
#include "shaders/include/frame.glsl"

layout(location = 0) in vec3 position_mm;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) in float occlusion;
layout(location = 5) in vec3 curvature_diagonal_per_mm;
layout(location = 6) in vec3 curvature_mixed_per_mm;
layout(location = 7) in vec3 occlusion_blurred;
layout(location = 8) in vec4 color_linear;
layout(location = 9) in vec2 atlas_uv;
layout(location = 10) in vec3 walked_gain;
#ifdef DERMIS_TENSION
layout(location = 13) in float tension;  // dermis/mesh/tension.h
#else
const float tension = 0.0;  // of a mesh at rest, which has no such stream
#endif

layout(location = 0) out vec3 p_world_mm_out;
layout(location = 1) out vec3 n_world_out;
layout(location = 2) out vec4 t_world_out;
layout(location = 3) out vec2 uv_out;
layout(location = 4) out float occlusion_out;
layout(location = 5) out vec3 curvature_diagonal_per_mm_out;
layout(location = 6) out vec3 curvature_mixed_per_mm_out;
layout(location = 7) out vec3 occlusion_blurred_out;
layout(location = 8) out vec4 color_linear_out;
layout(location = 9) out vec2 atlas_uv_out;
layout(location = 10) out vec3 walked_gain_out;
layout(location = 13) out float tension_out;

void write_varyings() {
    p_world_mm_out = position_mm;
    n_world_out = normal;
    t_world_out = tangent;
    uv_out = uv;
    occlusion_out = occlusion;
    curvature_diagonal_per_mm_out = curvature_diagonal_per_mm;
    curvature_mixed_per_mm_out = curvature_mixed_per_mm;
    occlusion_blurred_out = occlusion_blurred;
    color_linear_out = color_linear;
    atlas_uv_out = atlas_uv;
    walked_gain_out = walked_gain;
    tension_out = tension;
}
