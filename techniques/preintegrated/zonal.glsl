// Zonal harmonics of pre-integrated skin, summed over the Gaussians of its profile (shaders/include/skin/zonal.glsl): zh_0 =
// sqrt(pi) / 2, zh_1 = sqrt(pi / 3) mean rho_1, zh_2 = sqrt(5 pi) / 8 mean rho_2.
#ifndef DERMIS_ZONAL_GLSL
#define DERMIS_ZONAL_GLSL

#include "shaders/include/skin/zonal.glsl"
#include "techniques/preintegrated/skin.glsl"

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
