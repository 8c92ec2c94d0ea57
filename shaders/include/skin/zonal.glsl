// Light from all around on pre-integrated skin: zonal harmonics of a closed sphere of radius r, in closed form. A
// Gaussian of variance v has kappa = r^2 / v and the bands rho_1 = coth kappa - 1 / kappa and rho_2 = 1 - 3 rho_1 /
// kappa; the profile's are their mean by the Gaussians' weights times 1 - exp(-2 kappa). Arguments are a Gaussian's
// red, green, blue.
#ifndef DERMIS_SKIN_ZONAL_GLSL
#define DERMIS_SKIN_ZONAL_GLSL

// kappa, above 0; flat skin counts as a radius of 10 m.
vec3 lobe_kappa(float curvature_per_mm, vec3 variance_mm2) {
    float r_mm = 1.0 / max(curvature_per_mm, 1e-4);
    return r_mm * r_mm / variance_mm2;
}

// What the Gaussian's weight is multiplied with, 0 to 1: the part of it that a closed sphere holds.
vec3 lobe_part(vec3 kappa) { return 1.0 - exp(-2.0 * kappa); }

// rho_1 and rho_2, 0 to 1. At small kappa the formulas cancel; series replace them (error 1e-5).
vec3 lobe_band_1(vec3 kappa) {
    vec3 low = min(kappa, 0.5), high = max(kappa, 0.5);
    vec3 k2 = low * low, e = exp(-2.0 * high);
    vec3 series = low * (1.0 / 3.0 - k2 * (1.0 / 45.0 - k2 * (2.0 / 945.0)));
    vec3 closed = (1.0 + e) / (1.0 - e) - 1.0 / high;
    return mix(closed, series, step(kappa, vec3(0.5)));
}

vec3 lobe_band_2(vec3 kappa) {
    vec3 low = min(kappa, 0.5), high = max(kappa, 0.5);
    vec3 k2 = low * low;
    vec3 series = k2 * (1.0 / 15.0 - k2 * (2.0 / 315.0 - k2 / 1575.0));
    vec3 closed = 1.0 - 3.0 * lobe_band_1(high) / high;
    return mix(closed, series, step(kappa, vec3(0.5)));
}

#endif
