#version 460
#extension GL_GOOGLE_include_directive : require
// The largest of the tiles up to `count` away along one axis.
#include "shaders/include/frame.glsl"

uniform texture2D tiles;
layout(push_constant, scalar) uniform PassValues {
    int step_x;
    int step_y;
    int count;
};

layout(location = 0) out vec4 tile_out;

void main() {
    ivec2 last = textureSize(sampler2D(tiles, nearest_clamp), 0) - 1;
    float visible = 0.0;
    for (int i = -count; i <= count; ++i) {
        ivec2 at = clamp(ivec2(gl_FragCoord.xy) + ivec2(step_x, step_y) * i, ivec2(0), last);
        visible = max(visible, texelFetch(sampler2D(tiles, nearest_clamp), at, 0).r);
    }
    tile_out = vec4(visible);
}
