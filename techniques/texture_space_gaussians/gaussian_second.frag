#version 460
#extension GL_GOOGLE_include_directive : require
// Second half, which also adds its share to the profile's sum.
#include "techniques/texture_space_gaussians/gaussian.glsl"

uniform texture2D sum_before;  // of the narrower Gaussians; for the first the light before the blur

layout(push_constant, scalar) uniform PassValues {
    float sigma_mm;
    vec4 share;         // of this Gaussian in the sum; alpha: its part of a valid texel's 1
    vec4 share_before;  // of sum_before
};
layout(location = 0) out vec4 light_out;
layout(location = 1) out vec4 sum_out;

void main() {
    vec4 light = gaussian(sigma_mm);
    light_out = half_rounded(light);
    sum_out = half_rounded(light * share + texelFetch(sampler2D(sum_before, nearest_clamp), ivec2(gl_FragCoord.xy), 0) * share_before);
}
