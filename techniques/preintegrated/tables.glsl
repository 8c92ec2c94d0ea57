// The functions of the profile, read from tables.
#ifndef DERMIS_PREINTEGRATED_TABLES_GLSL
#define DERMIS_PREINTEGRATED_TABLES_GLSL

#include "shaders/include/surface.glsl"
#include "shaders/include/skin/table.glsl"
#include "techniques/preintegrated/constants.h"

uniform texture2D skin_lut;       // over N.L * .5 + .5 and curvature
uniform texture2D skin_rows;      // constants.h
#ifdef DERMIS_BECKMANN_TABLE
uniform texture2D skin_beckmann;  // tenth root of the distribution over sqrt(1 - N.H), sqrt(alpha)
#endif

vec4 read_row(int row, float x) {
    vec2 uv = vec2(texel_centres(x, float(kRowTexels)), (float(row) + 0.5) / float(kRowCount));
    return textureLod(sampler2D(skin_rows, trilinear_clamp), uv, 0.0);
}

#ifdef DERMIS_BECKMANN_TABLE
float beckmann_distribution(float n_dot_h, float alpha) {
    vec2 uv = beckmann_coordinate(n_dot_h, alpha);
    return beckmann_from_root(textureLod(sampler2D(skin_beckmann, trilinear_clamp), uv, 0.0).r);
}
#endif

vec3 profile_falloff(float n_dot_l, float k) {
    vec2 uv = diffuse_coordinate(n_dot_l, k, kMaxCurvaturePerMm);
    return textureLod(sampler2D(skin_lut, trilinear_clamp), uv, 0.0).rgb;
}

void profile_zonal(float k, out vec3 zh[3]) {
    for (int l = 0; l < 3; ++l) zh[l] = read_row(kRowZonal + l, k / kMaxCurvaturePerMm).rgb;
}

vec3 profile_edge(float visibility) { return read_row(kRowShadow, visibility).rgb; }

// techniques/preintegrated/weights.h: weights of the smoother normal; its level above the sharp one in alpha.
vec4 normal_blend(float sharp_mm) {
    int row = normals == kNormalsLerp ? kRowPublishedNormals : kRowNormals;
    return read_row(row, (log2(sharp_mm) - kMinLogMm) / (kMaxLogMm - kMinLogMm));
}

// The sphere on which red's mean normal has this length: its curvature, and the mean of the second Legendre polynomial of the
// angle between the normals.
vec2 sphere_of_mean(float mean_length) {
    return read_row(kRowOfMean, sqrt(max(1.0 - mean_length, 0.0))).rg * vec2(kMaxCurvaturePerMm, 1.0);
}

#endif
