// Specular reflection of one light. n: normal, l: to the light, v: to the eye, h: normalised half vector; arguments are
// their cosines, 0 to 1. alpha is the square of the perceptual roughness, 0.0009 to 1. The lobes return the BRDF times
// n_dot_l, per steradian, without Fresnel.
#ifndef DERMIS_SKIN_SPECULAR_GLSL
#define DERMIS_SKIN_SPECULAR_GLSL

#include "shaders/include/skin/pi.glsl"

// Fresnel reflectance, 0 to 1, of a dielectric that reflects f0 at normal incidence; skin: 0.028. Schlick 1994.
float fresnel_schlick(float f0, float cos_theta) {
    float m = clamp(1.0 - cos_theta, 0.0, 1.0);
    float m2 = m * m;
    return f0 + (1.0 - f0) * m2 * m2 * m;
}

// Normalised Blinn-Phong: exponent from alpha as 2 / alpha^2 - 2, which gives the lobe of a Beckmann surface (Walter
// et al. 2007); energy (n + 8) / (8 pi) (Hoffman 2010).
float blinn_phong(float n_dot_h, float n_dot_l, float alpha) {
    float exponent = max(2.0 / (alpha * alpha) - 2.0, 1.0);
    return (exponent + 8.0) / (8.0 * kPi) * pow(n_dot_h, exponent) * n_dot_l;
}

// GGX: Trowbridge, Reitz 1975 with height-correlated Smith visibility (Heitz 2014). 1 - n_dot_h^2 as a product, which
// keeps its digits near n_dot_h = 1.
float ggx(float n_dot_h, float n_dot_l, float n_dot_v, float alpha) {
    float a2 = alpha * alpha;
    float d = (1.0 - n_dot_h) * (1.0 + n_dot_h) + n_dot_h * n_dot_h * a2;
    float distribution = a2 / (kPi * d * d);
    float smith_l = n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0 - a2) + a2);
    float smith_v = n_dot_l * sqrt(n_dot_v * n_dot_v * (1.0 - a2) + a2);
    return distribution * 0.5 / max(smith_l + smith_v, 1e-6) * n_dot_l;
}

// Two GGX lobes around one perceptual roughness, 0.75 and 1.3 times as rough, 0.85 of the first: skin's sharp oil over
// a broad sheen (the published defaults of Unreal Engine's subsurface profile).
float two_lobe_ggx(float n_dot_h, float n_dot_l, float n_dot_v, float roughness) {
    float first = 0.75 * roughness, second = min(1.3 * roughness, 1.0);
    return mix(ggx(n_dot_h, n_dot_l, n_dot_v, second * second), ggx(n_dot_h, n_dot_l, n_dot_v, first * first), 0.85);
}

// Beckmann's distribution of normals, per steradian (Beckmann, Spizzichino 1963).
float beckmann(float n_dot_h, float alpha) {
    float c2 = max(n_dot_h * n_dot_h, 1e-4), a2 = alpha * alpha;
    return exp((n_dot_h - 1.0) * (n_dot_h + 1.0) / (a2 * c2)) / (kPi * a2 * c2 * c2);
}

// Kelemen, Szirmay-Kalos 2001: a distribution, Beckmann's by default, over |l + v|^2, which replaces 4 (h.v)^2 and
// most of the shadowing. d'Eon, Luebke 2007 leave out the distribution's 1 / pi; here it is normalised.
float kelemen_szirmay_kalos(float distribution, float n_dot_l, float h_dot_v) {
    return distribution * n_dot_l / max(4.0 * h_dot_v * h_dot_v, 1e-3);
}

// How much of the environment's reflection an occlusion leaves, 0 to 1: Lagarde, de Rousiers 2014, "Moving Frostbite to
// Physically Based Rendering". roughness is the perceptual one.
float specular_occlusion(float n_dot_v, float occlusion, float roughness) {
    return clamp(pow(n_dot_v + occlusion, exp2(-16.0 * roughness - 1.0)) - 1.0 + occlusion, 0.0, 1.0);
}

#endif
