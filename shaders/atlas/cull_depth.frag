#version 460
#extension GL_GOOGLE_include_directive : require
// The full-screen triangle lies at depth 0; what is dropped keeps the 1 it was cleared to.
#include "shaders/atlas/constants.h"
#include "shaders/include/frame.glsl"

uniform texture2D tiles;

void main() {
    if (texelFetch(sampler2D(tiles, nearest_clamp), ivec2(gl_FragCoord.xy) / kCullTile, 0).r == 0.0) discard;
}
