#version 460
#extension GL_GOOGLE_include_directive : require
// Depth of the skin that a light reaches: the shadow map's depth where it belongs to skin.
#include "shaders/include/cut_out.glsl"
#include "shaders/include/frame.glsl"

uniform texture2D shadow_map;

layout(constant_id = 40) const int has_cut_outs = 0;

// The same triangle drawn twice has the same depth; this allows for the last bit.
const float kSameDepth = 1e-6;

void main() {
    if (has_cut_outs != 0 && cut_out()) discard;
    if (gl_FragCoord.z > texelFetch(sampler2D(shadow_map, nearest_clamp), ivec2(gl_FragCoord.xy), 0).r + kSameDepth) discard;
}
