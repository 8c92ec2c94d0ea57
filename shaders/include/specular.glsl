// Specular reflection of one light: f_r * n_dot_l. Which model is a specialisation constant.
#ifndef DERMIS_SPECULAR_GLSL
#define DERMIS_SPECULAR_GLSL

#include "shaders/include/environment.glsl"
#include "shaders/include/frame.glsl"

layout(constant_id = 0) const int specular_model = kSpecularGgx;

// Schlick 1994.
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

// Trowbridge, Reitz 1975 with height-correlated Smith visibility (Heitz 2014).
float ggx(float n_dot_h, float n_dot_l, float n_dot_v, float alpha) {
    float a2 = alpha * alpha;
    float d = n_dot_h * n_dot_h * (a2 - 1.0) + 1.0;
    float distribution = a2 / (kPi * d * d);
    float smith_l = n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0 - a2) + a2);
    float smith_v = n_dot_l * sqrt(n_dot_v * n_dot_v * (1.0 - a2) + a2);
    return distribution * 0.5 / max(smith_l + smith_v, 1e-6) * n_dot_l;
}

// Two GGX lobes around one roughness, .75 and 1.3 times as rough, .85 of the first: skin's sharp oil over a broad sheen
// (the published defaults of Unreal Engine's subsurface profile).
float two_lobe_ggx(float n_dot_h, float n_dot_l, float n_dot_v, float roughness) {
    float first = 0.75 * roughness, second = min(1.3 * roughness, 1.0);
    return mix(ggx(n_dot_h, n_dot_l, n_dot_v, second * second), ggx(n_dot_h, n_dot_l, n_dot_v, first * first), 0.85);
}

// Kelemen, Szirmay-Kalos 2001: Beckmann's distribution over |l + v|^2, which replaces 4 (h.v)^2 and most of the
// shadowing. d'Eon, Luebke 2007 leave out the distribution's 1 / pi; here it is normalised. With DERMIS_BECKMANN_TABLE
// the includer defines beckmann(), which reads the distribution from its table.
#ifdef DERMIS_BECKMANN_TABLE
float beckmann(float n_dot_h, float alpha);
#else
float beckmann(float n_dot_h, float alpha) {
    float c2 = max(n_dot_h * n_dot_h, 1e-4), a2 = alpha * alpha;
    return exp((c2 - 1.0) / (a2 * c2)) / (kPi * a2 * c2 * c2);
}
#endif
float kelemen_szirmay_kalos(float n_dot_h, float n_dot_l, float h_dot_v, float alpha) {
    return beckmann(n_dot_h, alpha) * n_dot_l / max(4.0 * h_dot_v * h_dot_v, 1e-3);
}

float specular_reflection(vec3 n_world, vec3 to_eye_world, vec3 to_light_world, float roughness, float f0) {
    float n_dot_l = dot(n_world, to_light_world);
    if (n_dot_l <= 0.0 || specular_model == kSpecularNone) return 0.0;
    vec3 h = normalize(to_eye_world + to_light_world);
    float n_dot_h = clamp(dot(n_world, h), 0.0, 1.0);
    float n_dot_v = clamp(dot(n_world, to_eye_world), 1e-3, 1.0);
    float h_dot_v = clamp(dot(h, to_eye_world), 0.0, 1.0);
    float fresnel = fresnel_schlick(f0, h_dot_v);
    float alpha = roughness * roughness;
    if (specular_model == kSpecularBlinnPhong) return fresnel * blinn_phong(n_dot_h, n_dot_l, alpha);
    if (specular_model == kSpecularTwoLobe) return fresnel * two_lobe_ggx(n_dot_h, n_dot_l, n_dot_v, roughness);
    if (specular_model == kSpecularKsk) return fresnel * kelemen_szirmay_kalos(n_dot_h, n_dot_l, h_dot_v, alpha);
    return fresnel * ggx(n_dot_h, n_dot_l, n_dot_v, alpha);
}

// Of the environment: prefiltered for GGX, which every other model takes as its approximation; none reflects nothing.
vec3 reflected_environment(vec3 n_world, vec3 to_eye_world, float roughness, float f0, float occlusion) {
    if (specular_model == kSpecularNone) return vec3(0.0);
    return environment_specular(n_world, to_eye_world, roughness, f0, occlusion);
}

#endif
