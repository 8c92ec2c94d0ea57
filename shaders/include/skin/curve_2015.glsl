// The hand-made curves of Simon Yeung 2015, "Pre-Integrated Skin Shading" (his blog): fitted by eye to a ring table
// for radii of 2 to 16 mm; other radii count as the nearest of these. Error against the sphere integral, largest
// channel: 0.20 at r = 2 mm, 0.071 at 4, 0.019 at 8.
#ifndef DERMIS_SKIN_CURVE_2015_GLSL
#define DERMIS_SKIN_CURVE_2015_GLSL

// 0 at a radius of 2 mm, 1 at 16 mm.
float curve_2015_radius(float curvature_per_mm) {
    return (1.0 / clamp(curvature_per_mm, 0.0625, 0.5) - 2.0) / 14.0;
}

// Diffuse light, 0 to 1; n_dot_l from -1 to 1.
vec3 curve_2015_direct(float n_dot_l, float curvature_per_mm) {
    float x = n_dot_l * 0.5 + 0.5;
    float away = 1.0 - curve_2015_radius(curvature_per_mm);

    // r = 2 mm: a parabola (a cubic in blue) past the terminator, a line on the lit side.
    const vec3 low = vec3(0.0, 0.3, 0.3), high = vec3(1.0, 0.7, 0.7), offset = vec3(0.0, 0.06, 0.06);
    vec3 t = clamp((x - low - offset) / (high - low), 0.0, 1.0);
    vec3 dark = t * t * vec3(0.65, 0.5, 0.9) * vec3(1.0, 1.0, t.z) + vec3(0.045, 0.0, 0.0);
    vec3 lit = clamp((x - 1.0) * vec3(1.75, 2.0, 1.97) + 0.99, 0.0, 1.0);
    const vec3 mix_low = vec3(0.0, 0.35, 0.35), mix_high = vec3(1.0, 0.7, 0.6);
    vec3 m = clamp((x - mix_low) / (mix_high - mix_low), 0.0, 1.0);
    vec3 tight = mix(dark, lit, m * m);

    // r = 16 mm: lines.
    vec3 flat_skin = clamp((x - 1.0) * vec3(1.95, 2.0, 2.0) + vec3(0.99, 0.99, 1.0), 0.0, 1.0);

    float away2 = away * away;
    return mix(tight, flat_skin, 1.0 - away2 * away2);
}

// Zonal harmonics of order 0 and 1; order 2 is Lambert's in the article, 0.495416.
vec3 curve_2015_zonal_0(float curvature_per_mm) {
    float c = curve_2015_radius(curvature_per_mm);
    vec2 steep = 1.0 - clamp(c * vec2(3.0, 2.7), 0.0, 1.0);
    steep = steep * steep;
    steep = steep * steep;
    return vec3(1.0 / (c * 3.2 + 0.4), steep) * vec3(0.061659, 0.00991683, 0.003783) +
           vec3(0.868938, 0.885506, 0.885400);
}

vec3 curve_2015_zonal_1(float curvature_per_mm) {
    float c = curve_2015_radius(curvature_per_mm);
    float nearest = 1.0 - clamp(c * 2.7, 0.0, 1.0);
    vec3 tight = vec3(0.197573092, 0.0117447875, 0.0040980375) * (1.0 - nearest * nearest * nearest) +
                 vec3(0.7672169, 1.009236, 1.017741);
    return mix(vec3(1.018366, 1.022107, 1.022232), tight, (1.0 - c) * (1.0 - c));
}

#endif
