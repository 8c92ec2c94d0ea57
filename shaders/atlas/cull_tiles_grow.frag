#version 460
#extension GL_GOOGLE_include_directive : require
// The tiles from which light comes to those of `tiles`, in two passes: across, the largest reach of those that reach the tile
// along the row, plus 1; down, whether one of these reaches it along the column.
#include "shaders/include/frame.glsl"

uniform texture2D tiles, reach;
layout(push_constant, scalar) uniform PassValues {
    int across;
    int most_tiles;
};

layout(location = 0) out vec4 tile_out;

void main() {
    ivec2 last = textureSize(sampler2D(tiles, nearest_clamp), 0) - 1;
    ivec2 direction = across != 0 ? ivec2(1, 0) : ivec2(0, 1);
    float found = 0.0;
    for (int i = -most_tiles; i <= most_tiles; ++i) {
        ivec2 at = clamp(ivec2(gl_FragCoord.xy) + direction * i, ivec2(0), last);
        float value = texelFetch(sampler2D(tiles, nearest_clamp), at, 0).r;
        if (across != 0 && value > 0.0) value = texelFetch(sampler2D(reach, nearest_clamp), at, 0).r + 1.0;
        if (value > float(abs(i))) found = max(found, across != 0 ? value : 1.0);
    }
    tile_out = vec4(found);
}
