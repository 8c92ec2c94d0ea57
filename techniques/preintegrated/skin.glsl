// The scene's profile without textures: coefficients that are fitted when the scene is loaded (skin_values.cpp), and the
// functions that they belong to: the closed form of the diffuse light (shaders/include/skin/closed_form.glsl), zonal
// harmonics, a shadow's edge.
#ifndef DERMIS_PREINTEGRATED_SKIN_GLSL
#define DERMIS_PREINTEGRATED_SKIN_GLSL

#extension GL_EXT_scalar_block_layout : require

#include "shaders/include/skin/closed_form.glsl"
#include "shaders/include/skin/zonal.glsl"
#include "techniques/preintegrated/constants.h"

layout(scalar) uniform Skin {
    // dermis/optics/curvature_expressions.h; a, s, k0 and k1 are halved, because the light is half of their sum.
    vec3 form_a[kPolynomialTerms], form_s[kPolynomialTerms], form_k0[kPolynomialTerms], form_k1[kPolynomialTerms];
    vec3 form_q[2];
    vec3 zonal_0[kPolynomialTerms], zonal_1[kPolynomialTerms], zonal_2[kPolynomialTerms];
    float curvature_knee;
    // dermis/optics/edge_expression.h; squared widths.
    vec3 edge[kEdgeWeights], edge_width2[2];
    // Weights that sum to 1 in each channel, variance in mm^2.
    vec4 gaussians[kMaxGaussians];
    int gaussian_count;
    float widest_blend_mm;  // weights.h
    float transmission_reach_mm, transmission_nearest;  // dermis/technique/transmission.h
    // Height at distance 0 per mm^2, and in alpha the exponent of 2 for a squared distance in mm^2.
    vec4 transmission_gaussians[kTransmissionGaussians];
};

float knee_of(float k) { return knee_coordinate(k, curvature_knee); }

vec3 polynomial(vec3 p[kPolynomialTerms], float u) { return polynomial_6(u, p[0], p[1], p[2], p[3], p[4], p[5]); }

vec3 closed_form(vec3 t, float k) {
    float u = knee_of(k);
    return line_and_hyperbola(t, 0.5 + polynomial(form_a, u), 0.5 + polynomial(form_s, u),
                              k * (form_q[0] + u * form_q[1]), polynomial(form_k0, u), polynomial(form_k1, u));
}

void closed_form_zonal(float k, out vec3 zh[3]) {
    float u = knee_of(k);
    zh[0] = 0.886226925 + polynomial(zonal_0, u);
    zh[1] = 1.023326708 + polynomial(zonal_1, u);
    zh[2] = 0.495415912 + polynomial(zonal_2, u);
}

// A shadow's edge over visibility (dermis/optics/edge_expression.h).
vec3 scattered_edge(float visibility) {
    return edge_of_hyperbolas(visibility, edge[0], edge[1], edge[2], edge[3], edge[4], edge_width2[0], edge[5], edge_width2[1]);
}

// Zonal harmonics of pre-integrated skin, summed over the Gaussians of its profile (shaders/include/skin/zonal.glsl): zh_0 =
// sqrt(pi) / 2, zh_1 = sqrt(pi / 3) mean rho_1, zh_2 = sqrt(5 pi) / 8 mean rho_2.
void exact_zonal(float curvature_per_mm, out vec3 zh[3]) {
    vec3 total = vec3(0.0), sum_1 = vec3(0.0), sum_2 = vec3(0.0);
    for (int i = 0; i < gaussian_count; ++i) {
        vec3 kappa = lobe_kappa(curvature_per_mm, gaussians[i].aaa);
        vec3 weight = gaussians[i].rgb * lobe_part(kappa);
        total += weight;
        sum_1 += weight * lobe_band_1(kappa);
        sum_2 += weight * lobe_band_2(kappa);
    }
    zh[0] = vec3(0.886226925);
    zh[1] = 1.023326708 * sum_1 / total;
    zh[2] = 0.495415912 * sum_2 / total;
}

#endif
