// Reads the colour shadow map of Gosselin, Sander, Mitchell 2004: depth from the key light in alpha, optical depth of the
// translucent surfaces before it in RGB, or with the source's lookup the sum of their opacities. With a second light the map is shared as they sketch: R and A are the key light's
// (one channel of opacity), G and B the second light's opacity and depth.
#ifndef DERMIS_SHADOW_CHANNELS_GLSL
#define DERMIS_SHADOW_CHANNELS_GLSL

#include "shaders/atlas/constants.h"
#include "shaders/include/shadow.glsl"

uniform texture2D shadow_channels;

layout(constant_id = 10) const int channels = kChannelsNone;
layout(constant_id = 11) const int shadow_lookup = kLookupDisk;

// The source's bias, in the light's depth range.
const float kSourceDepthBias = 0.01;
// Spacing of half floats near 1.
const float kHalfStep = 1.0 / 2048.0;

// Light through the translucent surfaces, to the power that darkens it (trans_shadow_alpha).
vec3 tint_of(vec3 added, float darkening) {
    if (shadow_lookup == kLookupDisk) return exp(-added * darkening);
    return darkening == 0.0 ? vec3(1.0) : pow(max(1.0 - added, vec3(0.0)), vec3(darkening));
}
vec3 key_light_tint(vec4 texel, float darkening) {
    return tint_of(channels == kChannelsTwoLights ? texel.rrr : texel.rgb, darkening);
}

// Visibility times tint of the key light, both over a disk of `width_mm`.
vec3 key_light_through(vec3 p_mm, vec3 n_geometry_world, vec3 to_light_world, float width_mm, float darkening) {
    if (shadow_lookup == kLookupSingle) {
        // The source's own test: one texel, no filter, a constant bias.
        vec3 p = shadow_map_position(light_view_projection, p_mm);
        if (outside_shadow_map(p)) return vec3(1.0);
        vec4 texel = textureLod(sampler2D(shadow_channels, nearest_clamp), p.xy, 0.0);
        return p.z - kSourceDepthBias < texel.a ? key_light_tint(texel, darkening) : vec3(0.0);
    }
    float visibility = shadow_visibility(p_mm, n_geometry_world, to_light_world, width_mm);
    if (channels == kChannelsNone || visibility == 0.0) return vec3(visibility);
    ShadowDisk disk =
        shadow_disk(light_view_projection, p_mm, n_geometry_world, to_light_world, filter_radius_mm(width_mm));
    if (outside_shadow_map(disk.center)) return vec3(visibility);
    vec3 tint = vec3(0.0);
    for (int i = 0; i < kTintTaps; ++i)
        tint += key_light_tint(textureLod(sampler2D(shadow_channels, linear_clamp),
                                   shadow_tap_position(disk, vogel_disk(i, kTintTaps)).xy, 0.0), darkening);
    return visibility * tint / float(kTintTaps);
}

// The same for the second light, whose depth is in B: compared tap by tap.
vec3 second_light_through(vec3 p_mm, vec3 n_geometry_world, vec3 to_light_world, float width_mm, float darkening) {
    bool single = shadow_lookup == kLookupSingle;
    ShadowDisk disk = shadow_disk(second_light_view_projection, p_mm, n_geometry_world, to_light_world,
                                  filter_radius_mm(width_mm));
    if (single) disk.center = shadow_map_position(second_light_view_projection, p_mm);
    if (outside_shadow_map(disk.center)) return vec3(1.0);
    float bias = single ? kSourceDepthBias : 2.0 * kHalfStep;
    int taps = single ? 1 : kShadowTaps;
    float sum = 0.0;
    for (int i = 0; i < taps; ++i) {
        vec3 p = single ? disk.center : shadow_tap_position(disk, vogel_disk(i, taps));
        vec4 texel = textureLod(sampler2D(shadow_channels, nearest_clamp), p.xy, 0.0);
        if (p.z - bias < texel.b) sum += tint_of(texel.ggg, darkening).r;
    }
    return vec3(sum / float(taps));
}

#endif
