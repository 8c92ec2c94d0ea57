// Specular reflection of one light: f_r * n_dot_l. Which model is a specialisation constant.
#ifndef DERMIS_SPECULAR_GLSL
#define DERMIS_SPECULAR_GLSL

#include "shaders/include/environment.glsl"
#include "shaders/include/frame.glsl"
#include "shaders/include/skin/specular.glsl"

layout(constant_id = 0) const int specular_model = kSpecularGgx;

// With DERMIS_BECKMANN_TABLE the includer defines this, and reads the distribution from its table.
#ifdef DERMIS_BECKMANN_TABLE
float beckmann_distribution(float n_dot_h, float alpha);
#else
float beckmann_distribution(float n_dot_h, float alpha) { return beckmann(n_dot_h, alpha); }
#endif

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
    if (specular_model == kSpecularKsk)
        return fresnel * kelemen_szirmay_kalos(beckmann_distribution(n_dot_h, alpha), n_dot_l, h_dot_v);
    return fresnel * ggx(n_dot_h, n_dot_l, n_dot_v, alpha);
}

// ksk has its own lobe; blinn_phong and two_lobe_ggx take GGX's for theirs.
int specular_lobe() { return specular_model == kSpecularKsk ? kBrdfLobeKsk : kBrdfLobeGgx; }

// Of the environment; none reflects nothing.
vec3 reflected_environment(vec3 n_world, vec3 to_eye_world, float roughness, float f0, float occlusion) {
    if (specular_model == kSpecularNone) return vec3(0.0);
    return environment_specular(specular_lobe(), n_world, to_eye_world, roughness, f0, occlusion);
}

#endif
