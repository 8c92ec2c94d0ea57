#version 460
#extension GL_GOOGLE_include_directive : require
// A translucent surface seen from a light, added into colour channels: its optical depth, minus the logarithm of its
// transmittance, whose sums are products of transmittances; or its opacity, as Gosselin, Sander, Mitchell 2004 add it.
#include "shaders/include/translucent.glsl"

layout(constant_id = 0) const int single_channel = 0;
layout(constant_id = 1) const int adds_opacity = 0;

layout(location = 0) out vec4 added_out;

const float kMinTransmittance = 1.0 / 1024.0;

void main() {
    vec3 transmittance = surface_transmittance();
    if (single_channel != 0) transmittance = transmittance.rrr;
    vec3 optical_depth = -log(clamp(transmittance, kMinTransmittance, 1.0));
    added_out = vec4(adds_opacity != 0 ? 1.0 - transmittance : optical_depth, 0.0);
}
