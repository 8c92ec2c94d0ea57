// Light from the environment: irradiance as order-2 spherical harmonics, reflections as a prefiltered cube.
#ifndef DERMIS_ENVIRONMENT_GLSL
#define DERMIS_ENVIRONMENT_GLSL

#include "shaders/include/frame.glsl"
#include "shaders/include/skin/specular.glsl"

uniform textureCube environment_cube;
// Of each lobe F0 scale and bias of the split sum, and their means: n.v from left to right, roughness from top to bottom
// (scene/brdf_table.h).
uniform texture2D environment_brdf;

vec3 to_environment(vec3 d_world) {
    float c = environment_turn.x, s = environment_turn.y;
    return vec3(c * d_world.x - s * d_world.z, d_world.y, s * d_world.x + c * d_world.z);
}

// Sum of l-band weights times the bands of the environment. For irradiance the weights are the cosine lobe's
// (pi, 2 pi / 3, pi / 4; Ramamoorthi, Hanrahan 2001); a scattering skin has its own per channel.
vec3 environment_convolved(vec3 n_world, vec3 band_0, vec3 band_1, vec3 band_2) {
    vec3 n = n_world;
    vec3 l1 = n.y * environment_terms[1] + n.z * environment_terms[2] + n.x * environment_terms[3];
    vec3 l2 = n.x * n.y * environment_terms[4] + n.y * n.z * environment_terms[5] + n.x * n.z * environment_terms[7] +
              (3.0 * n.z * n.z - 1.0) * environment_terms[6] + (n.x * n.x - n.y * n.y) * environment_terms[8];
    return max(band_0 * environment_terms[0] + band_1 * l1 + band_2 * l2, vec3(0.0));
}

vec3 environment_irradiance(vec3 n_world) {
    return environment_convolved(n_world, vec3(kPi), vec3(2.0 * kPi / 3.0), vec3(kPi / 4.0));
}

vec4 brdf_terms(int lobe, float roughness, float cosine) {
    float size = float(kBrdfTableSize);
    float row = clamp(roughness * size, 0.5, size - 0.5) + float(lobe) * size;
    return textureLod(sampler2D(environment_brdf, trilinear_clamp), vec2(cosine, row / (size * float(kBrdfLobes))), 0.0);
}

// The cube is prefiltered for GGX. Beckmann's lobe has shorter tails, as GGX has of another roughness.
float roughness_in_cube(int lobe, float roughness) {
    if (lobe == kBrdfLobeGgx) return roughness;
    return min(roughness * clamp(kBeckmannAsGgxAt0 + kBeckmannAsGgxSlope * roughness, kBeckmannAsGgxLeast,
                                 kBeckmannAsGgxMost), 1.0);
}

vec3 environment_specular(int lobe, vec3 n_world, vec3 to_eye_world, float roughness, float f0, float occlusion) {
    float n_dot_v = clamp(dot(n_world, to_eye_world), 1e-3, 1.0);
    vec3 r_world = reflect(-to_eye_world, n_world);
    vec3 radiance = textureLod(samplerCube(environment_cube, trilinear_clamp), to_environment(r_world),
                               roughness_in_cube(lobe, roughness) * (environment_mip_count - 1.0)).rgb;
    vec4 brdf = brdf_terms(lobe, roughness, n_dot_v);
    return radiance * environment_intensity * (f0 * brdf.x + brdf.y) *
           specular_occlusion(n_dot_v, occlusion, roughness);
}

#endif
