#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/include/half_floats.glsl"
#include "techniques/screen_space_separable/blur.glsl"

layout(location = 0) out vec4 light_out;

void main() {
    vec3 blurred[1];
    light_out = half_rounded(blur(blurred) ? vec4(blurred[0], 1.0) : vec4(0.0));
}
