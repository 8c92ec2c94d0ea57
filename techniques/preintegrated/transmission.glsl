// Light that enters the skin elsewhere and leaves here, gathered from the shadow map (Dachsbacher and Stamminger 2003,
// "Translucent Shadow Maps"): every texel holds a lit point of the skin, and whatever way that faces, the light it takes in
// is what falls on the texel's own area. So M(x) = int E R(|x - y|) dA over the lit side is a sum over texels without
// normals.
#ifndef DERMIS_TRANSMISSION_GLSL
#define DERMIS_TRANSMISSION_GLSL

#include "shaders/include/shadow.glsl"
#include "shaders/include/skin/table.glsl"
#include "techniques/preintegrated/constants.h"

const float kWidestRingMm = 6.0;
const float kFadeStartMm = 0.7 * kMaxDistanceMm;
const int kTransmissionTaps = 20;

// In units of the light's irradiance at normal incidence; `table` holds R per mm^2 over the distance. Taps are in rings at
// even steps of radius, which is closer than even cover where R is large; each counts for its ring's area. Where
// no lit skin is near along the light, as on most of a head's dark side, one tap is all.
vec3 transmitted_light(texture2D table, vec3 p_mm, vec3 to_light_world) {
    vec3 here = shadow_map_position(light_view_projection, p_mm);
    if (outside_shadow_map(here)) return vec3(0.0);
    float mm_per_z = 1.0 / (here.z - shadow_map_position(light_view_projection, p_mm + to_light_world).z);
    float lit_z = textureLod(sampler2D(shadow_map, nearest_clamp), here.xy, 0.0).r;
    // Profiles that reach farther than the table would end at an edge.
    float fade = 1.0 - smoothstep(kFadeStartMm, kMaxDistanceMm, (here.z - lit_z) * mm_per_z);
    if (fade == 0.0) return vec3(0.0);
    // Axes of a millimetre across the light.
    ShadowDisk disk = shadow_disk(light_view_projection, p_mm, to_light_world, to_light_world, 1.0);
    float size = float(textureSize(sampler2D(table, linear_clamp), 0).x);
    float step_mm = kWidestRingMm / float(kTransmissionTaps);
    vec3 light = vec3(0.0);
    for (int i = 0; i < kTransmissionTaps; ++i) {
        float radius_mm = (float(i) + 0.5) * step_mm, angle = float(i) * kGoldenAngle;
        vec2 tap = here.xy + radius_mm * (cos(angle) * disk.axis_x.xy + sin(angle) * disk.axis_y.xy);
        float tap_z = textureLod(sampler2D(shadow_map, nearest_clamp), tap, 0.0).r;
        if (tap_z == 1.0) continue;  // no skin
        float depth_mm = (here.z - tap_z) * mm_per_z;
        float distance_mm = sqrt(radius_mm * radius_mm + depth_mm * depth_mm);
        float u = texel_centres(distance_mm / kMaxDistanceMm, size);
        light += radius_mm * textureLod(sampler2D(table, linear_clamp), vec2(u, 0.5), 0.0).rgb;
    }
    return light * fade * 2.0 * kPi * step_mm;
}

#endif
