#version 460
#extension GL_GOOGLE_include_directive : require
// The first direction of a kernel of two products.
#define DERMIS_TERMS 2
#include "techniques/screen_space_separable/blur.glsl"

layout(location = 0) out vec4 light_out;
layout(location = 1) out vec4 light_of_second_out;

void main() {
    vec3 blurred[2];
    bool skin = blur(blurred);
    light_out = skin ? vec4(blurred[0], 1.0) : vec4(0.0);
    light_of_second_out = skin ? vec4(blurred[1], 1.0) : vec4(0.0);
}
