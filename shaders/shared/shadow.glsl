// Visibility of the key light: percentage-closer filtering over a disk whose width is given in mm.
#ifndef DERMIS_SHADOW_GLSL
#define DERMIS_SHADOW_GLSL

#include "shared/frame.glsl"

layout(set = 0, binding = 10) uniform texture2D shadow_map;

const int kShadowTaps = 24;
const float kGoldenAngle = 2.39996323;

// Point `index` of a Vogel spiral: even cover of the unit disk by any number of points (Vogel 1979).
vec2 vogel_disk(int index, int count) {
    float radius = sqrt((float(index) + 0.5) / float(count));
    float angle = float(index) * kGoldenAngle;
    return radius * vec2(cos(angle), sin(angle));
}

float shadow_depth_tap(vec3 p_light) {
    return texture(sampler2DShadow(shadow_map, shadow_compare), p_light);
}

// 0 in shadow, 1 lit. The lookup is moved off the surface along its normal, more at grazing light, which hides
// acne without lifting shadows off the contact (Holbert 2011). Outside the map everything is lit.
float shadow_visibility(vec3 p_world_mm, vec3 n_geometry_world, vec3 to_light_world, float width_mm) {
    float n_dot_l = clamp(dot(n_geometry_world, to_light_world), 0.0, 1.0);
    float radius_mm = max(0.5 * width_mm, shadow_texel_mm);
    float slope = sqrt(1.0 - n_dot_l * n_dot_l);
    vec3 p_mm = p_world_mm + n_geometry_world * (slope * radius_mm + 1.5 * shadow_texel_mm);
    vec4 p_clip = light_view_projection * vec4(p_mm, 1.0);
    vec3 p_light = vec3(p_clip.xy / p_clip.w * 0.5 + 0.5, p_clip.z / p_clip.w);
    if (any(lessThan(p_light, vec3(0.0))) || any(greaterThan(p_light, vec3(1.0)))) return 1.0;
    vec2 texel = 1.0 / vec2(textureSize(sampler2DShadow(shadow_map, shadow_compare), 0));
    float radius_texels = radius_mm / shadow_texel_mm;
    float lit = 0.0;
    for (int i = 0; i < kShadowTaps; ++i)
        lit += shadow_depth_tap(vec3(p_light.xy + vogel_disk(i, kShadowTaps) * radius_texels * texel, p_light.z));
    return lit / float(kShadowTaps);
}

#endif
