// Zonal harmonics of pre-integrated skin on a closed sphere, in closed form: zh_0 = sqrt(pi) / 2, zh_1 = sqrt(pi / 3) sum
// w rho_1(kappa), zh_2 = sqrt(5 pi) / 8 sum w rho_2(kappa), kappa = r^2 / v, rho_1 = coth kappa - 1 / kappa, rho_2 = 1 - 3
// rho_1 / kappa, w the Gaussians' weights times 1 - exp(-2 kappa), summing to 1 (docs/preintegration.md).
#ifndef DERMIS_ZONAL_GLSL
#define DERMIS_ZONAL_GLSL

#include "techniques/preintegrated/skin.glsl"

// rho_1 and rho_2; both differences of near numbers at small kappa, where their series take over (error 1e-5).
vec2 lobe_bands(float kappa) {
    float k2 = kappa * kappa;
    if (kappa < 0.5)
        return vec2(kappa * (1.0 / 3.0 - k2 * (1.0 / 45.0 - k2 * (2.0 / 945.0))),
                    k2 * (1.0 / 15.0 - k2 * (2.0 / 315.0 - k2 / 1575.0)));
    float e = exp(-2.0 * kappa);
    float rho_1 = (1.0 + e) / (1.0 - e) - 1.0 / kappa;
    return vec2(rho_1, 1.0 - 3.0 * rho_1 / kappa);
}

void exact_zonal(float curvature_per_mm, out vec3 zh[3]) {
    float r_mm = 1.0 / max(curvature_per_mm, 1e-4);
    vec3 total = vec3(0.0), sum_1 = vec3(0.0), sum_2 = vec3(0.0);
    for (int i = 0; i < gaussian_count; ++i) {
        vec4 term = gaussians[i];
        float kappa = r_mm * r_mm / term.a;
        vec3 weight = term.rgb * (1.0 - exp(-2.0 * kappa));
        vec2 rho = lobe_bands(kappa);
        total += weight;
        sum_1 += weight * rho.x;
        sum_2 += weight * rho.y;
    }
    zh[0] = vec3(0.886226925);
    zh[1] = 1.023326708 * sum_1 / total;
    zh[2] = 0.495415912 * sum_2 / total;
}

#endif
