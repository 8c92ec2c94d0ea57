#version 460
#extension GL_GOOGLE_include_directive : require
// Wrapped diffuse: light reaches past the terminator (Green 2004, GPU Gems, chapter 16).
#define DERMIS_TRANSMISSION
#include "shaders/include/forward.glsl"
#include "techniques/wrap/constants.h"

layout(scalar) uniform Params {
    float wrap;
    float scatter_width;
    vec3 scatter_color_linear;
};
layout(push_constant, scalar) uniform PassValues {
    vec3 second_moment_mm2;
    vec3 bend_mm2;
};
layout(constant_id = 2) const int width = kWidthProfile;

// Least squares over spheres of 1 to 16 mm: matching the zonal harmonic of order 1 alone (a scale of 2) darkens the lit
// side by more than it should.
const float kReachScale = 1.3;

vec3 reach(Surface s) {
    if (width == kWidthSource) return vec3(wrap);
    float k = mean_curvature_per_mm(s), k2 = k * k;
    return min(kReachScale * second_moment_mm2 * k2 / (1.0 + bend_mm2 * k2), vec3(1.0));
}

// (n.l + w) / (1 + w), scaled by a further 1 / (1 + w) so that energy is conserved: the integral over the sphere of directions
// then stays pi (McAuley 2010).
vec3 wrapped_cosine(float n_dot_l, vec3 w) { return max(n_dot_l + w, vec3(0.0)) / ((1.0 + w) * (1.0 + w)); }

// A bump over the wrapped cosine around the terminator, from 0 to scatter_width and back at twice that.
float terminator_bump(float wrapped) {
    return smoothstep(0.0, scatter_width, wrapped) * (1.0 - smoothstep(scatter_width, 2.0 * scatter_width, wrapped));
}

vec3 direct_response(Surface s, vec3 to_light_world, float visibility) {
    vec3 wrapped = wrapped_cosine(dot(s.n_world, to_light_world), reach(s));
    if (width == kWidthSource) wrapped += scatter_color_linear * terminator_bump(wrapped.r);
    return wrapped * visibility;
}

// Legendre moments of the wrapped cosine, w in 0..1: 2 pi times the integral of f(t) P_l(t) over t in -w..1 is pi,
// pi (2 - w) / 3 and pi (1 - w)^2 / 4; at w = 0 they are Lambert's.
vec3 ambient_response(Surface s) {
    vec3 w = reach(s);
    return environment_convolved(s.n_world, vec3(kPi), kPi * (2.0 - w) / 3.0, kPi * (1.0 - w) * (1.0 - w) / 4.0) *
           s.occlusion;
}
