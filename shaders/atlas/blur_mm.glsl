// Blurs over the atlas in millimetres. A light map's texels are (exitance, 1) where skin is and 0 elsewhere, so that sums
// of taps divided by their alpha leave out what was never written. atlas_metric has two steps along the surface, at right
// angles to each other there, in texels; their directions depend on the surface normal alone, so that the two sides of
// a seam agree on them, independent of their UV layout (separable blurs need that).
#ifndef DERMIS_ATLAS_MM_GLSL
#define DERMIS_ATLAS_MM_GLSL

#include "shaders/atlas/constants.h"
#include "shaders/include/half_floats.glsl"
#include "shaders/include/frame.glsl"

uniform texture2D source;
uniform texture2D atlas_metric;
uniform texture2D seam_map;
uniform texture2D chart_map;
layout(constant_id = 13) const int carry = 1;  // gutter texels hold the light from across the UV seam; 0: they hold nothing

// Where the atlas has the surface that a gutter texel continues, in texels; negative: nowhere. Stored as multiples of 8 and
// remainders, which half floats hold to 1/256.
vec2 carried_to(ivec2 texel) {
    if (carry == 0) return vec2(-1.0);
    vec4 packed = texelFetch(sampler2D(seam_map, nearest_clamp), texel, 0);
    return packed.xz * 8.0 + packed.yw;
}

float chart_at(vec2 at) {
    ivec2 last = textureSize(sampler2D(chart_map, nearest_clamp), 0) - 1;
    return texelFetch(sampler2D(chart_map, nearest_clamp), clamp(ivec2(floor(at)), ivec2(0), last), 0).r;
}

struct BlurCentre {
    vec2 at;     // in texels
    vec4 steps;  // xy, zw: texels
    float chart;
    bool is_skin;
};

BlurCentre blur_centre(ivec2 texel) {
    vec4 steps = texelFetch(sampler2D(atlas_metric, nearest_clamp), texel, 0);
    vec2 at = vec2(texel) + 0.5;
    if (steps == vec4(0.0)) {
        at = carried_to(texel);
        if (at.x < 0.0) return BlurCentre(at, steps, 0.0, false);
        steps = texelFetch(sampler2D(atlas_metric, nearest_clamp), ivec2(floor(at)), 0);
    }
    return BlurCentre(at, steps, chart_at(at), steps != vec4(0.0));
}

vec4 light_at(vec2 at) {
    return textureLod(sampler2D(source, linear_clamp), at / vec2(textureSize(sampler2D(source, linear_clamp), 0)), 0.0);
}

vec4 normalize_by_alpha(vec4 sum) { return sum.a > 0.0 ? vec4(sum.rgb / sum.a, 1.0) : vec4(0.0); }

#endif
