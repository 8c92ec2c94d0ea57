#version 460
#extension GL_GOOGLE_include_directive : require
// First half of a separable Gaussian.
#include "techniques/texture_space_gaussians/gaussian.glsl"

layout(push_constant, scalar) uniform PassValues { float sigma_mm; };
layout(location = 0) out vec4 light_out;

void main() { light_out = half_rounded(gaussian(sigma_mm)); }
