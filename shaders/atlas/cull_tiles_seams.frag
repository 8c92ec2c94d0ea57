#version 460
#extension GL_GOOGLE_include_directive : require
// The tiles with a gutter texel that holds the light of a needed texel across a seam.
#include "shaders/atlas/blur_mm.glsl"

uniform texture2D tiles;

layout(location = 0) out vec4 tile_out;

float tile_at(ivec2 texel) { return texelFetch(sampler2D(tiles, nearest_clamp), texel / kCullTile, 0).r; }

void main() {
    ivec2 last = textureSize(sampler2D(seam_map, nearest_clamp), 0) - 1;
    ivec2 first = ivec2(gl_FragCoord.xy) * kCullTile;
    float needed = 0.0;
    for (int y = 0; y < kCullTile && needed == 0.0; ++y)
        for (int x = 0; x < kCullTile; ++x) {
            vec2 at = carried_to(min(first + ivec2(x, y), last));
            if (at.x >= 0.0) needed = max(needed, tile_at(ivec2(at)));
        }
    tile_out = vec4(needed);
}
