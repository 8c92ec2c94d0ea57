#version 460
#extension GL_GOOGLE_include_directive : require
// Wrapped diffuse: light reaches past the terminator (Green 2004, GPU Gems, chapter 16).
#define DERMIS_TRANSMISSION
#include "shaders/include/forward.glsl"
#include "shaders/include/skin/wrap.glsl"
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

vec3 reach(Surface s) {
    if (width == kWidthSource) return vec3(wrap);
    return wrap_reach(mean_curvature_per_mm(s), second_moment_mm2, bend_mm2);
}

// A bump over the wrapped cosine around the terminator, from 0 to scatter_width and back at twice that.
float terminator_bump(float wrapped) {
    return smoothstep(0.0, scatter_width, wrapped) * (1.0 - smoothstep(scatter_width, 2.0 * scatter_width, wrapped));
}

vec3 direct_response(Surface s, vec3 to_light_world) {
    vec3 wrapped = wrapped_cosine(dot(s.n_world, to_light_world), reach(s));
    if (width == kWidthSource) wrapped += scatter_color_linear * terminator_bump(wrapped.r);
    return wrapped;
}

vec3 ambient_response(Surface s) {
    vec3 w = reach(s);
    return environment_convolved(s.n_world, vec3(kPi), wrapped_band_1(w), wrapped_band_2(w)) * s.occlusion;
}
