#version 460
#extension GL_GOOGLE_include_directive : require
// Second half, which also adds its share to the profile's sum (additive blending).
#include "techniques/texture_space_gaussians/gaussian.glsl"

layout(location = 0) out vec4 light_out;
layout(location = 1) out vec4 sum_out;

void main() {
    light_out = gaussian();
    sum_out = light_out * share;
}
