#version 460
#extension GL_GOOGLE_include_directive : require
// The second direction of a kernel of two products, and their sum.
#define DERMIS_TERMS 2
#include "shaders/include/half_floats.glsl"
#include "techniques/screen_space_separable/blur.glsl"

layout(location = 0) out vec4 light_out;

void main() {
    vec3 blurred[2];
    light_out = half_rounded(blur(blurred) ? vec4(max(blurred[0] + blurred[1], vec3(0.0)), 1.0) : vec4(0.0));
}
