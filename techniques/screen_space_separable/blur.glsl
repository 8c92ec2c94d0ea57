// One direction of the blur. Taps lie at squared steps, dense in the middle (Jimenez et al. 2015, section 6). Each
// represents the cell that ends half way to its neighbours; its weight is the difference of the kernel's cumulative
// function at the ends of the cell, so that Gaussians much narrower than a pixel keep their whole weight. Distances
// are those of the points on the skin, not of the pixels: a cell on a slope is longer than its projection, and a tap
// behind a gap is too far away to count.
#ifndef DERMIS_SEPARABLE_BLUR_GLSL
#define DERMIS_SEPARABLE_BLUR_GLSL

#extension GL_EXT_control_flow_attributes : require
#include "shaders/include/skin/table.glsl"
#include "shaders/screen/rays.glsl"
#include "techniques/screen_space_separable/constants.h"

// Products a(x) a(y) that the kernel is a sum of.
#ifndef DERMIS_TERMS
#define DERMIS_TERMS 1
#endif

uniform texture2D light;
#if DERMIS_TERMS == 2
uniform texture2D light_of_second;
#endif
uniform texture2D skin_z;
uniform texture2D skin_kernel;  // a row for each term: its light within a distance, over sqrt(distance / reach)

layout(constant_id = 10) const int half_taps = 8;
layout(constant_id = 11) const int along_v = 0;
layout(constant_id = 12) const int follow = kFollowSurface;

layout(push_constant, scalar) uniform PassValues { float reach_mm; };

layout(location = 0) in vec2 uv;

// On both sides.
vec3 share_within(float distance_mm, int term) {
    float size = float(textureSize(sampler2D(skin_kernel, linear_clamp), 0).x);
    float u = texel_centres(sqrt(clamp(distance_mm / reach_mm, 0.0, 1.0)), size);
    return textureLod(sampler2D(skin_kernel, linear_clamp), vec2(u, (float(term) + 0.5) / float(DERMIS_TERMS)), 0.0).rgb;
}

// In mm on the picture's plane through the point; i from 0 to half_taps.
float tap_mm(float i) { return reach_mm * (i / float(half_taps)) * (i / float(half_taps)); }

// What each term blurs, alpha 1 on skin: the same for both along x, what each left there along y.
void read_light(vec2 tap_uv, out vec4 taps[DERMIS_TERMS]) {
    taps[0] = textureLod(sampler2D(light, linear_clamp), tap_uv, 0.0);
#if DERMIS_TERMS == 2
    taps[1] = textureLod(sampler2D(light_of_second, linear_clamp), tap_uv, 0.0);
#endif
}

// False where there is no skin.
bool blur(out vec3 blurred[DERMIS_TERMS]) {
    vec4 middle[DERMIS_TERMS];
    middle[0] = textureLod(sampler2D(light, nearest_clamp), uv, 0.0);
#if DERMIS_TERMS == 2
    middle[1] = textureLod(sampler2D(light_of_second, nearest_clamp), uv, 0.0);
#endif
    float z_mm = textureLod(sampler2D(skin_z, nearest_clamp), uv, 0.0).r;
    vec3 weights[DERMIS_TERMS], around[DERMIS_TERMS];  // around: a further term's light with the first one's weights, all positive
    for (int term = 0; term < DERMIS_TERMS; ++term)
        blurred[term] = vec3(0.0), weights[term] = vec3(0.0), around[term] = vec3(0.0);
    if (middle[0].a == 0.0) return false;
    PictureRays rays = picture_rays();
    vec3 p_mm = picture_point_mm(rays, uv, z_mm);
    vec2 uv_per_mm = along_v == 0 ? vec2(1.0 / (z_mm * length(rays.right)), 0.0)
                                  : vec2(0.0, 1.0 / (z_mm * length(rays.down)));
    float middle_stretch = 1e9;
    [[unroll]] for (int side = -1; side <= 1; side += 2)
        for (int i = 1; i <= half_taps; ++i) {
            float offset_mm = tap_mm(float(i));
            vec2 tap_uv = uv + float(side) * offset_mm * uv_per_mm;
            vec4 taps[DERMIS_TERMS];
            read_light(tap_uv, taps);
            if (taps[0].a < 1e-3) continue;
            float stretch = 1.0;  // mm on the skin per mm on the picture
            if (follow == kFollowSurface) {
                float tap_z_mm = textureLod(sampler2D(skin_z, linear_clamp), tap_uv, 0.0).r / taps[0].a;
                stretch = distance(picture_point_mm(rays, tap_uv, tap_z_mm), p_mm) / offset_mm;
            }
            if (i == 1) middle_stretch = min(middle_stretch, stretch);
            float begin_mm = 0.5 * (tap_mm(float(i - 1)) + offset_mm);
            float end_mm = i == half_taps ? offset_mm : 0.5 * (offset_mm + tap_mm(float(i + 1)));
            vec3 first = vec3(0.0);
            for (int term = 0; term < DERMIS_TERMS; ++term) {
                vec3 weight = 0.5 * taps[0].a *
                              (share_within(end_mm * stretch, term) - share_within(begin_mm * stretch, term));
                if (term == 0) first = weight;
                blurred[term] += weight * taps[term].rgb / taps[0].a;
                if (term > 0) around[term] += first * taps[term].rgb / taps[0].a;
                weights[term] += weight;
            }
        }
    if (middle_stretch > 1e8) middle_stretch = 1.0;
    vec3 first = vec3(0.0);
    for (int term = 0; term < DERMIS_TERMS; ++term) {
        vec3 weight = share_within(0.5 * tap_mm(1.0) * middle_stretch, term);
        if (term == 0) first = weight;
        blurred[term] += weight * middle[term].rgb;
        if (term > 0) around[term] += first * middle[term].rgb;
        weights[term] += weight;
    }
    // What lies behind a silhouette or a gap is taken to be as what is seen. A term is not divided by its own weights, which
    // may be near 0: only together have the terms all light.
    around[0] = blurred[0];
    for (int term = 0; term < DERMIS_TERMS; ++term)
        blurred[term] += (share_within(reach_mm, term) - weights[term]) * around[term] / max(weights[0], vec3(1e-6));
    return true;
}

#endif
