// The functions of the profile as tables have them.
#ifndef DERMIS_PREINTEGRATED_TABLES_GLSL
#define DERMIS_PREINTEGRATED_TABLES_GLSL

#include "shaders/include/surface.glsl"
#include "shaders/include/skin/table.glsl"
#include "techniques/preintegrated/constants.h"

uniform texture2D skin_lut;           // N.L * .5 + .5, curvature
uniform texture2D skin_zonal;         // curvature, order 0 to 2
uniform texture2D skin_shadow;        // visibility, under shadow_width_mm
uniform texture2D skin_normal_blend;  // log2 of a texel in mm: weights, levels
uniform texture2D skin_beckmann;      // sqrt(1 - N.H), sqrt(alpha): tenth root

vec4 read_row(texture2D table, float x, float row) {
    float size = float(textureSize(sampler2D(table, linear_clamp), 0).x);
    return textureLod(sampler2D(table, linear_clamp), vec2(texel_centres(x, size), row), 0.0);
}

float beckmann_distribution(float n_dot_h, float alpha) {
    vec2 uv = beckmann_coordinate(n_dot_h, alpha);
    return beckmann_from_root(textureLod(sampler2D(skin_beckmann, linear_clamp), uv, 0.0).r);
}

vec3 profile_falloff(float n_dot_l, float k) {
    vec2 uv = diffuse_coordinate(n_dot_l, k, kMaxCurvaturePerMm);
    return textureLod(sampler2D(skin_lut, linear_clamp), uv, 0.0).rgb;
}

void profile_zonal(float k, out vec3 zh[3]) {
    for (int l = 0; l < 3; ++l) zh[l] = read_row(skin_zonal, k / kMaxCurvaturePerMm, (float(l) + 0.5) / 3.0).rgb;
}

vec3 profile_edge(float visibility) { return read_row(skin_shadow, visibility, 0.5).rgb; }

// techniques/preintegrated/normal_blend.h: weights of the smoother normal, and how many levels up it is.
vec4 normal_blend(float sharp_mm) {
    return read_row(skin_normal_blend, (log2(sharp_mm) - kMinLogMm) / (kMaxLogMm - kMinLogMm), 0.5);
}

#endif
