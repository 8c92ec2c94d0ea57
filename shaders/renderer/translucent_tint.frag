#version 460
#extension GL_GOOGLE_include_directive : require
// A translucent surface over the picture, first half: multiplies the background by its transmittance. The order of
// surfaces does not change the product.
#include "shaders/include/translucent.glsl"

layout(location = 0) out vec4 transmittance_out;

void main() { transmittance_out = vec4(surface_transmittance(), 1.0); }
