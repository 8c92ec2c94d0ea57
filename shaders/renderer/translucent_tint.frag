#version 460
#extension GL_GOOGLE_include_directive : require
// Glass over the picture, first half: what lies behind is multiplied by what the glass lets through. Products do not mind
// the order of the sheets.
#include "shaders/include/translucent.glsl"

layout(location = 0) out vec4 transmittance_out;

void main() { transmittance_out = vec4(surface_transmittance(), 1.0); }
