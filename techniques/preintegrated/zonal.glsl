// Zonal harmonics of pre-integrated skin, summed over the Gaussians of its profile (shaders/include/skin/zonal.glsl): zh_0 =
// sqrt(pi) / 2, zh_1 = sqrt(pi / 3) mean rho_1, zh_2 = sqrt(5 pi) / 8 mean rho_2.
#ifndef DERMIS_ZONAL_GLSL
#define DERMIS_ZONAL_GLSL

#include "shaders/include/skin/zonal.glsl"

// `gaussians` holds a term a column: weights, below them variances in mm^2.
void exact_zonal(texture2D gaussians, sampler nearest_sampler, float curvature_per_mm, out vec3 zh[3]) {
    vec3 total = vec3(0.0), sum_1 = vec3(0.0), sum_2 = vec3(0.0);
    int count = textureSize(sampler2D(gaussians, nearest_sampler), 0).x;
    for (int i = 0; i < count; ++i) {
        vec3 weight = texelFetch(sampler2D(gaussians, nearest_sampler), ivec2(i, 0), 0).rgb;
        vec3 variance_mm2 = texelFetch(sampler2D(gaussians, nearest_sampler), ivec2(i, 1), 0).rgb;
        vec3 kappa = lobe_kappa(curvature_per_mm, variance_mm2);
        weight *= lobe_part(kappa);
        total += weight;
        sum_1 += weight * lobe_band_1(kappa);
        sum_2 += weight * lobe_band_2(kappa);
    }
    zh[0] = vec3(0.886226925);
    zh[1] = 1.023326708 * sum_1 / total;
    zh[2] = 0.495415912 * sum_2 / total;
}

#endif
