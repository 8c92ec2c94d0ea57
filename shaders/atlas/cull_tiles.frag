#version 460
#extension GL_GOOGLE_include_directive : require
// x: a tile is visible when any of its texels is. y: the longest step of the metric in it, in texels, in any direction.
#include "shaders/atlas/constants.h"
#include "shaders/include/frame.glsl"

uniform texture2D atlas_visible, atlas_metric;
layout(constant_id = 0) const int by_steps = 0;

layout(location = 0) out vec4 tile_out;

// The largest singular value of the matrix of both steps, squared.
float longest_squared(vec4 steps) {
    float sum = dot(steps, steps), determinant = steps.x * steps.w - steps.y * steps.z;
    return 0.5 * (sum + sqrt(max(sum * sum - 4.0 * determinant * determinant, 0.0)));
}

void main() {
    ivec2 size = textureSize(sampler2D(atlas_visible, nearest_clamp), 0);
    ivec2 first = ivec2(gl_FragCoord.xy) * kCullTile;
    float visible = 0.0, longest = 0.0;
    for (int y = 0; y < kCullTile; ++y)
        for (int x = 0; x < kCullTile; ++x) {
            ivec2 at = min(first + ivec2(x, y), size - 1);
            visible = max(visible, texelFetch(sampler2D(atlas_visible, nearest_clamp), at, 0).r);
            if (by_steps != 0)
                longest = max(longest, longest_squared(texelFetch(sampler2D(atlas_metric, nearest_clamp), at, 0)));
        }
    tile_out = vec4(visible, sqrt(longest), 0.0, 0.0);
}
