#version 460
#extension GL_GOOGLE_include_directive : require
// mesh_screen.vert for meshes in a pose, whose vertices have a tension.
#define DERMIS_TENSION
#include "shaders/include/mesh_vertex.glsl"

invariant gl_Position;  // passes that test for equal depth rely on it

void main() {
    write_varyings();
    gl_Position = view_projection * vec4(position_mm, 1.0);
}
