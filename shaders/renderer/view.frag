#version 460
#extension GL_GOOGLE_include_directive : require
// The G-buffer made visible. Signed numbers: blue concave or compressed, grey flat, red convex or stretched; the legend
// at the bottom says so, with ticks and unit.
#include "shaders/include/frame.glsl"
#include "shaders/renderer/constants.h"
#include "shaders/renderer/tone_map.glsl"

uniform texture2D gbuffer_position;
uniform texture2D gbuffer_normal;
uniform texture2D gbuffer_geometry;
uniform texture2D gbuffer_albedo;
uniform texture2D gbuffer_light;
uniform texture2D view_legend;  // ink of ticks and words: dermis/render/legend.h

layout(constant_id = 0) const int shown = kShownNormal;

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 display_out;

vec4 fetch(texture2D image) { return texelFetch(sampler2D(image, nearest_clamp), ivec2(gl_FragCoord.xy), 0); }

vec3 signed_color(float x) {
    const vec3 concave = vec3(0.13, 0.35, 0.75), flat_color = vec3(0.86), convex = vec3(0.75, 0.12, 0.10);
    return mix(flat_color, x < 0.0 ? concave : convex, clamp(abs(x), 0.0, 1.0));
}

vec3 view_color(vec4 position, vec4 light) {
    switch (shown) {
        case kShownNormal: return fetch(gbuffer_normal).xyz * 0.5 + 0.5;
        case kShownGeometryNormal: return fetch(gbuffer_geometry).xyz * 0.5 + 0.5;
        case kShownAlbedo: return srgb_encode(fetch(gbuffer_albedo).rgb);
        case kShownRoughness: return vec3(fetch(gbuffer_albedo).a);
        case kShownCurvature: return signed_color(fetch(gbuffer_normal).a / kFullCurvaturePerMm);
        case kShownTension: return signed_color(fetch(gbuffer_normal).a / kFullTension);
        case kShownOcclusion: return vec3(fetch(gbuffer_geometry).a);
        case kShownShadow: return vec3(light.a);
        case kShownNDotL: return signed_color(light.b);
        case kShownDepth: return vec3(1.0 - clamp((position.w - distance(eye_world_mm, bounds_center_mm)) /
                                             (2.0 * bounds_radius_mm) + 0.5, 0.0, 1.0));
        case kShownUv: return vec3(light.xy, 0.0);
        default: return (position.xyz - bounds_center_mm) / (2.0 * bounds_radius_mm) + 0.5;
    }
}

// Centred at the bottom, one texel a pixel, smaller in pictures that are narrower.
vec3 with_legend(vec3 color) {
    vec2 size = vec2(textureSize(sampler2D(view_legend, linear_clamp), 0));
    vec2 picture = vec2(textureSize(sampler2D(gbuffer_position, nearest_clamp), 0));
    float scale = min(1.0, 0.95 * picture.x / size.x);
    vec2 corner = vec2(0.5 * (picture.x - size.x * scale), picture.y - (size.y + 4.0) * scale);
    vec2 p = (gl_FragCoord.xy - corner) / scale;
    if (any(lessThan(p, vec2(0.0))) || any(greaterThan(p, size))) return color;
    const vec2 bar_low = vec2(kLegendBarLeft, kLegendBarTop), bar_high = vec2(kLegendBarRight, kLegendBarBottom);
    vec2 bar = (p - bar_low) / (bar_high - bar_low);
    bool inside = all(greaterThan(bar, vec2(0.0))) && all(lessThan(bar, vec2(1.0)));
    vec3 paper = inside ? signed_color(bar.x * 2.0 - 1.0) : vec3(0.06);
    return mix(paper, vec3(0.95), textureLod(sampler2D(view_legend, linear_clamp), p / size, 0.0).r);
}

void main() {
    vec4 position = fetch(gbuffer_position);
    vec3 color = position.w > 0.0 ? view_color(position, fetch(gbuffer_light)) : vec3(0.12);
    if (shown == kShownCurvature || shown == kShownNDotL || shown == kShownTension) color = with_legend(color);
    display_out = vec4(color, 1.0);
}
