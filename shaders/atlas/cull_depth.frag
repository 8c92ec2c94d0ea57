#version 460
#extension GL_GOOGLE_include_directive : require
// The full-screen triangle lies at depth 0; what is dropped keeps the 1 it was cleared to.
#include "shaders/include/frame.glsl"

uniform texture2D tiles;
layout(constant_id = 0) const int tile = 8;

void main() {
    if (texelFetch(sampler2D(tiles, nearest_clamp), ivec2(gl_FragCoord.xy) / tile, 0).r == 0.0) discard;
}
