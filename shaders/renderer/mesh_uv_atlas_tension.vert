#version 460
#extension GL_GOOGLE_include_directive : require
// mesh_uv_atlas.vert for meshes in a pose, whose vertices have a tension.
#define DERMIS_TENSION
#include "shaders/include/mesh_vertex.glsl"

invariant gl_Position;  // passes that test for equal depth rely on it

void main() {
    write_varyings();
    gl_Position = vec4(atlas_uv * 2.0 - 1.0, 0.0, 1.0);
}
