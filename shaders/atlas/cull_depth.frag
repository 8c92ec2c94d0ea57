#version 460
#extension GL_GOOGLE_include_directive : require
// The full-screen triangle is at depth 0; dropped texels keep the clear value 1.
#include "shaders/atlas/constants.h"
#include "shaders/include/frame.glsl"

uniform texture2D tiles, tiles_beyond;

void main() {
    ivec2 tile = ivec2(gl_FragCoord.xy) / kCullTile;
    if (texelFetch(sampler2D(tiles, nearest_clamp), tile, 0).r == 0.0 &&
        texelFetch(sampler2D(tiles_beyond, nearest_clamp), tile, 0).r == 0.0)
        discard;
}
