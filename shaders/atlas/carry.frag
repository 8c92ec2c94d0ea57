#version 460
#extension GL_GOOGLE_include_directive : require
// Fills the gutter texels of a light map with the light from across the UV seam, so that blurs can read over it.
#include "shaders/atlas/blur_mm.glsl"

layout(location = 0) out vec4 light_out;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    light_out = texelFetch(sampler2D(source, nearest_clamp), texel, 0);
    if (light_out.a > 0.0) return;
    vec2 at = carried_to(texel);
    if (at.x < 0.0) return;
    light_out = half_rounded(normalize_by_alpha(light_at(at)));
}
