#version 460
#extension GL_GOOGLE_include_directive : require
// First half of a separable Gaussian.
#include "techniques/texture_space_gaussians/gaussian.glsl"

layout(location = 0) out vec4 light_out;

void main() { light_out = gaussian(); }
