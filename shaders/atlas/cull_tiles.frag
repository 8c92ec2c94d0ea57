#version 460
#extension GL_GOOGLE_include_directive : require
// A tile is visible when any of its texels is.
#include "shaders/atlas/constants.h"
#include "shaders/include/frame.glsl"

uniform texture2D atlas_visible;

layout(location = 0) out vec4 tile_out;

void main() {
    ivec2 size = textureSize(sampler2D(atlas_visible, nearest_clamp), 0);
    ivec2 first = ivec2(gl_FragCoord.xy) * kCullTile;
    float visible = 0.0;
    for (int y = 0; y < kCullTile && visible == 0.0; ++y)
        for (int x = 0; x < kCullTile; ++x) {
            ivec2 at = min(first + ivec2(x, y), size - 1);
            visible = max(visible, texelFetch(sampler2D(atlas_visible, nearest_clamp), at, 0).r);
        }
    tile_out = vec4(visible);
}
