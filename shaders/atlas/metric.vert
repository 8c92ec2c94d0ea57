#version 460
#extension GL_GOOGLE_include_directive : require
// Draws in the skin's atlas, with the derivatives of the position by u and v.
#include "shaders/include/mesh_vertex.glsl"

layout(location = 11) in vec3 du_mm;  // of a step of 1 in the atlas's u
layout(location = 12) in vec3 dv_mm;
layout(location = 11) out vec3 du_mm_out;
layout(location = 12) out vec3 dv_mm_out;

invariant gl_Position;  // passes that test for equal depth rely on it

void main() {
    write_varyings();
    du_mm_out = du_mm;
    dv_mm_out = dv_mm;
    gl_Position = vec4(atlas_uv * 2.0 - 1.0, 0.0, 1.0);
}
