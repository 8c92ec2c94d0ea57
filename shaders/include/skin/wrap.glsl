// Wrapped diffuse: light reaches past the terminator by w, 0 to 1 a channel (Green 2004, GPU Gems, chapter 16).
#ifndef DERMIS_SKIN_WRAP_GLSL
#define DERMIS_SKIN_WRAP_GLSL

#include "shaders/include/skin/pi.glsl"

// Least squares over spheres of 1 to 16 mm: matching the zonal harmonic of order 1 alone (a scale of 2) darkens the lit
// side by more than it should.
const float kReachScale = 1.3;

// How far light reaches on skin of this mean curvature, any sign. second_moment_mm2 and bend_mm2 are the profile's.
vec3 wrap_reach(float curvature_per_mm, vec3 second_moment_mm2, vec3 bend_mm2) {
    float k2 = curvature_per_mm * curvature_per_mm;
    return min(kReachScale * second_moment_mm2 * k2 / (1.0 + bend_mm2 * k2), 1.0);
}

// Radiant exitance over irradiance at normal incidence, 0 to 1; n_dot_l from -1 to 1. (n.l + w) / (1 + w), scaled by a
// further 1 / (1 + w) so that energy is conserved: the integral over the sphere of directions then is pi (McAuley
// 2010).
vec3 wrapped_cosine(float n_dot_l, vec3 w) { return max(n_dot_l + w, 0.0) / ((1.0 + w) * (1.0 + w)); }

// Light from all around, as spherical harmonics: what the bands of order 1 and 2 are multiplied with in place of
// Lambert's 2 pi / 3 and pi / 4; order 0 keeps pi. 2 pi times the integral of the wrapped cosine's f(t) P_l(t) over t
// in -w..1.
vec3 wrapped_band_1(vec3 w) { return kPi * (2.0 - w) / 3.0; }

vec3 wrapped_band_2(vec3 w) { return kPi * (1.0 - w) * (1.0 - w) / 4.0; }

#endif
