// Tone mapping, linear in and linear out (0..1), and the sRGB encoding.
#ifndef DERMIS_TONE_MAP_GLSL
#define DERMIS_TONE_MAP_GLSL

#include "shaders/renderer/constants.h"

// Hable 2010, "Uncharted 2: HDR Lighting": ratio of two quadratics, shoulder .15, linear .5 at angle .1, toe .2,
// numerator .02, denominator .3; white 11.2; exposure bias 2.
vec3 hable_curve(vec3 x) {
    return (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.50) + 0.06) - 0.02 / 0.30;
}
vec3 hable(vec3 radiance) { return hable_curve(2.0 * radiance) / hable_curve(vec3(11.2)).x; }

// ACES RRT and ODT as fitted by Hill 2015 (in "BakingLab"): matrices in, rational curve, matrices out.
vec3 aces(vec3 radiance) {
    const mat3 to_rrt = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
    const mat3 from_odt = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
    vec3 v = to_rrt * radiance;
    vec3 curve = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return from_odt * curve;
}

// Khronos PBR Neutral 2024: identity but for an F0 offset up to .8 - .04, then compression that desaturates.
vec3 pbr_neutral(vec3 radiance) {
    const float start = 0.8 - 0.04, desaturation = 0.15;
    float low = min(radiance.r, min(radiance.g, radiance.b));
    float offset = low < 0.08 ? low - 6.25 * low * low : 0.04;
    vec3 color = radiance - offset;
    float peak = max(color.r, max(color.g, color.b));
    if (peak < start) return color;
    float d = 1.0 - start;
    float new_peak = 1.0 - d * d / (peak + d - start);
    color *= new_peak / peak;
    float g = 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0);
    return mix(color, vec3(new_peak), g);
}

vec3 tone_mapped(vec3 radiance, int operator_index) {
    vec3 color = radiance;
    if (operator_index == kToneMapHable) color = hable(radiance);
    if (operator_index == kToneMapAces) color = aces(radiance);
    if (operator_index == kToneMapPbrNeutral) color = pbr_neutral(radiance);
    return clamp(color, 0.0, 1.0);
}

vec3 srgb_encode(vec3 linear) {
    return mix(12.92 * linear, 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055,
               greaterThan(linear, vec3(0.0031308)));
}

#endif
