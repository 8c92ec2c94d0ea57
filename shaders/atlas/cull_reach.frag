#version 460
#extension GL_GOOGLE_include_directive : require
// How many tiles the light of a tile may come from, in two passes. Its steps are no longer than the longest in all tiles that
// they may lead to; so a reach is valid where the steps of that very neighbourhood give no larger one. Four sizes of
// neighbourhood are tried, the smallest first.
#include "shaders/atlas/constants.h"
#include "shaders/include/frame.glsl"

uniform texture2D tiles;
layout(push_constant, scalar) uniform PassValues {
    int across;
    int most_tiles;  // with steps as long as they may be
    float reach_texels;
    float reach_steps;
};

layout(location = 0) out vec4 reach_out;

ivec4 neighbourhoods() { return (most_tiles * ivec4(1, 2, 3, 4) + 3) / 4; }

void main() {
    ivec2 last = textureSize(sampler2D(tiles, nearest_clamp), 0) - 1;
    ivec2 direction = across != 0 ? ivec2(1, 0) : ivec2(0, 1);
    vec4 longest = vec4(0.0);
    for (int i = -most_tiles; i <= most_tiles; ++i) {
        ivec2 at = clamp(ivec2(gl_FragCoord.xy) + direction * i, ivec2(0), last);
        vec4 there = texelFetch(sampler2D(tiles, nearest_clamp), at, 0);
        if (across != 0) there = there.yyyy;
        longest = max(longest, there * vec4(lessThanEqual(ivec4(abs(i)), neighbourhoods())));
    }
    reach_out = longest;
    if (across != 0) return;
    ivec4 asked = ivec4(ceil((reach_texels + reach_steps * longest) / float(kCullTile)));
    int reach = most_tiles;
    for (int k = 3; k >= 0; --k)
        if (asked[k] <= neighbourhoods()[k]) reach = min(reach, asked[k]);
    reach_out = vec4(reach);
}
