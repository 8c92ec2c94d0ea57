// The functions of tables.glsl as expressions, without a table.
#ifndef DERMIS_PREINTEGRATED_EXPRESSIONS_GLSL
#define DERMIS_PREINTEGRATED_EXPRESSIONS_GLSL

#include "shaders/include/skin/transmission.glsl"
#include "techniques/preintegrated/skin.glsl"

vec3 profile_falloff(float n_dot_l, float k) { return closed_form(vec3(n_dot_l), k); }
void profile_zonal(float k, out vec3 zh[3]) { closed_form_zonal(k, zh); }
vec3 profile_edge(float visibility) { return scattered_edge(visibility); }

// The formula of techniques/preintegrated/weights.h, once per pixel. There is no return before the loop, because lavapipe
// (Mesa 22.3) compiles one to code that writes past its stack.
vec4 normal_blend(float sharp_mm) {
    float levels = clamp(log2(widest_blend_mm / sharp_mm), 0.0, kPublishedNormalLevels);
    if (normals == kNormalsLerp) levels = kPublishedNormalLevels;
    float s0 = sharp_mm * sharp_mm / 12.0, s1 = s0 * exp2(2.0 * levels);
    vec3 kept = vec3(0.0);
    for (int i = 0; i < gaussian_count; ++i) {
        float v = gaussians[i].a;
        kept += gaussians[i].rgb * (sqrt(s0 + s1 + v) - sqrt(2.0 * s0 + v));
    }
    float sharp = sqrt(2.0 * s0), both = sqrt(s0 + s1), smooth_only = sqrt(2.0 * s1);
    vec3 weight = clamp((both - sharp - kept) / max(2.0 * both - sharp - smooth_only, 1e-9), 0.0, 1.0);
    return levels < 1e-3 ? vec4(0.0) : vec4(weight, levels);
}

// dermis/technique/transmission.h: R per mm^2 over its integral, and the reach. R is the sum of the Gaussians.
vec3 transmission_profile(float distance_over_reach) {
    float d = transmission_reach_mm * max(distance_over_reach, transmission_nearest);
    vec3 r = vec3(0.0);
    for (int i = 0; i < kTransmissionGaussians; ++i)
        r += transmission_gaussians[i].rgb * gaussian_falloff(d, transmission_gaussians[i].a);
    return r;
}
float transmission_reach() { return transmission_reach_mm; }

#endif
