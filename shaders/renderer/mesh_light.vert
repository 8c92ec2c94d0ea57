#version 460
#extension GL_GOOGLE_include_directive : require
// Draws from a light into its shadow map.
#include "shaders/include/mesh_vertex.glsl"

layout(constant_id = 0) const int from_light = -1;  // index into lights; -1: the key light

invariant gl_Position;  // passes that test for equal depth rely on it

void main() {
    write_varyings();
    gl_Position = (from_light < 0 ? light_view_projection : lights[from_light].light_view_projection) *
                  vec4(position_mm, 1.0);
}
