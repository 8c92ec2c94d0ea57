#version 460
#extension GL_GOOGLE_include_directive : require
// Scattered light of one direction as lobes around that direction (Pettineo 2020). Their sharpness follows from the profile
// and the curvature. On a sphere each Gaussian of the profile is exactly such a lobe; its irradiance is approximate.
#define DERMIS_TRANSMISSION
#define DERMIS_OWN_BODY
#include "shaders/include/forward.glsl"
#include "shaders/include/skin/curvature.glsl"
#include "shaders/include/skin/spherical_gaussians.glsl"
#include "shaders/include/skin/zonal.glsl"
#include "techniques/spherical_gaussians/constants.h"

layout(scalar) uniform Skin {
    vec3 lobe_weight[kMaxLobes], lobe_variance_mm2[kMaxLobes];
};
layout(constant_id = 2) const int lobe_count = 2;

float curvature_towards_per_mm(Surface s, vec3 to_light_world) {
    return curvature_towards(s.curvature_diagonal_per_mm, s.curvature_mixed_per_mm, s.n_geometry_world, to_light_world);
}

// A shadow's edge is not scattered.
vec3 direct_response(Surface s, vec3 to_light_world) {
    float n_dot_l = dot(s.n_world, to_light_world), k = curvature_towards_per_mm(s, to_light_world);
    vec3 light = vec3(0.0), total = vec3(0.0);
    for (int i = 0; i < lobe_count; ++i) {
        // This order keeps the shader within 64 registers.
        vec3 kappa = lobe_kappa(k, lobe_variance_mm2[i]), of_lobe = lobe_light(n_dot_l, kappa);
        vec3 weight = lobe_weight[i] * lobe_part(kappa);
        light += weight * of_lobe;
        total += weight;
    }
    return light / total;
}

// The chord of the sphere on which the lobes scatter.
float own_way_mm(Surface s, vec3 to_light_world) {
    return 2.0 * max(-dot(s.n_geometry_world, to_light_world), 0.0) /
           max(curvature_towards_per_mm(s, to_light_world), 1e-4);
}

// The zonal harmonics of the lobes, which are exact; Hill's fit is not used here.
vec3 ambient_response(Surface s) {
    float k = curvature_around(s.curvature_diagonal_per_mm, s.curvature_mixed_per_mm);
    vec3 total = vec3(0.0), sum_1 = vec3(0.0), sum_2 = vec3(0.0);
    for (int i = 0; i < lobe_count; ++i) {
        vec3 kappa = lobe_kappa(k, lobe_variance_mm2[i]), weight = lobe_weight[i] * lobe_part(kappa);
        total += weight;
        sum_1 += weight * lobe_band_1(kappa);
        sum_2 += weight * lobe_band_2(kappa);
    }
    return environment_convolved(s.n_world, vec3(kPi), 2.0 * kPi / 3.0 * sum_1 / total, kPi / 4.0 * sum_2 / total) *
           s.occlusion;
}
