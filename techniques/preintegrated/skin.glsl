// What the scene's profile gives, fitted when the scene is loaded (expressions.cpp): values, not textures.
#ifndef DERMIS_PREINTEGRATED_SKIN_GLSL
#define DERMIS_PREINTEGRATED_SKIN_GLSL

#extension GL_EXT_scalar_block_layout : require

#include "shaders/include/skin/closed_form.glsl"
#include "techniques/preintegrated/constants.h"

layout(scalar) uniform Skin {
    // dermis/optics/curvature_expressions.h; a, s, k0 and k1 halved, as the light is half of their sum.
    vec3 form_a[kPolynomialTerms], form_s[kPolynomialTerms], form_k0[kPolynomialTerms], form_k1[kPolynomialTerms];
    vec3 form_q[2];
    vec3 zonal_0[kPolynomialTerms], zonal_1[kPolynomialTerms], zonal_2[kPolynomialTerms];
    float curvature_knee;
    // dermis/optics/edge_expression.h; squared widths.
    vec3 edge[kEdgeWeights], edge_width2[2];
    // Weights that sum to 1 in each channel, variance in mm^2.
    vec4 gaussians[kMaxGaussians];
    int gaussian_count;
    float widest_blend_mm;  // normal_blend.h
    float transmission_reach_mm, transmission_nearest;  // dermis/technique/transmission.h
    // Height at distance 0 per mm^2, and in alpha the exponent of 2 for a squared distance in mm^2.
    vec4 transmission_gaussians[kTransmissionGaussians];
};

float knee_of(float k) { return knee_coordinate(k, curvature_knee); }

vec3 polynomial(vec3 p[kPolynomialTerms], float u) { return polynomial_6(u, p[0], p[1], p[2], p[3], p[4], p[5]); }

#endif
