// Diffuse light reduced by the specular reflection (skin.specular_reduces_diffuse of the scene): the matte part of
// Kelemen, Szirmay-Kalos 2001, "A Microfacet Based Coupled Specular-Matte BRDF Model". a(c) is the part of light at cosine c
// that the lobe reflects, A its mean over the hemisphere, weighted by the cosine. Light enters by 1 - a(n.l), leaves by
// 1 - a(n.v), and the product is over 1 - A, so that the albedo is what the surface returns per light that entered:
// under even light a(n.v) + albedo (1 - a(n.v)), never more than 1 for an albedo of at most 1.
#ifndef DERMIS_REDUCED_DIFFUSE_GLSL
#define DERMIS_REDUCED_DIFFUSE_GLSL

#include "shaders/include/specular.glsl"
#include "shaders/include/surface.glsl"

layout(constant_id = 33) const int reduced_diffuse = 0;

float not_reflected(vec2 scale_and_bias, float f0) {
    return 1.0 - min(f0 * scale_and_bias.x + scale_and_bias.y, 1.0);
}

// Of light from one direction, with 1 / (1 - A). Even light keeps a factor of 1, as its mean of 1 - a is 1 - A.
float diffuse_entry(Surface s, float n_dot_l) {
    if (reduced_diffuse == 0) return 1.0;
    vec4 terms = brdf_terms(specular_lobe(), s.roughness, clamp(n_dot_l, 0.0, 1.0));
    return not_reflected(terms.xy, s.f0) / max(not_reflected(terms.zw, s.f0), 1e-3);
}

float diffuse_exit(Surface s) {
    if (reduced_diffuse == 0) return 1.0;
    float n_dot_v = clamp(dot(s.n_world, s.to_eye_world), 1e-3, 1.0);
    return not_reflected(brdf_terms(specular_lobe(), s.roughness, n_dot_v).xy, s.f0);
}

#endif
