#version 460
#extension GL_GOOGLE_include_directive : require
// A translucent surface seen from a light, added into colour channels. Added is its optical depth, minus the logarithm of
// its transmittance: sums of it are products of transmittances, so the order of surfaces does not matter. (The
// source adds opacities, which can exceed 1.)
#include "shaders/include/translucent.glsl"

layout(constant_id = 0) const int single_channel = 0;

layout(location = 0) out vec4 optical_depth_out;

const float kMinTransmittance = 1.0 / 1024.0;

void main() {
    vec3 transmittance = surface_transmittance();
    if (single_channel != 0) transmittance = transmittance.rrr;
    optical_depth_out = vec4(-log(clamp(transmittance, kMinTransmittance, 1.0)), 0.0);
}
