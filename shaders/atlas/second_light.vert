#version 460
#extension GL_GOOGLE_include_directive : require
// Draws from the second light.
#include "shaders/include/mesh_vertex.glsl"

invariant gl_Position;  // passes that test for equal depth rely on it

void main() {
    write_varyings();
    gl_Position = second_light_view_projection * vec4(position_mm, 1.0);
}
