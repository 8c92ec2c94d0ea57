#version 460
#extension GL_GOOGLE_include_directive : require
// Wrapped diffuse: light reaches past the terminator, with an added colour there (Green 2004, GPU Gems, chapter 16).
#include "shaders/include/forward.glsl"

layout(scalar) uniform Params {
    float wrap;
    float scatter_width;
    vec3 scatter_color_linear;
};

// (n.l + w) / (1 + w), scaled by a further 1 / (1 + w) so that energy is conserved: the integral over the sphere of directions
// then stays pi (McAuley 2010).
float wrapped_cosine(float n_dot_l) { return max(n_dot_l + wrap, 0.0) / ((1.0 + wrap) * (1.0 + wrap)); }

// A bump over the wrapped cosine around the terminator, from 0 to scatter_width and back at twice that.
float terminator_bump(float wrapped) {
    return smoothstep(0.0, scatter_width, wrapped) * (1.0 - smoothstep(scatter_width, 2.0 * scatter_width, wrapped));
}

vec3 direct_response(Surface s, vec3 to_light_world, float visibility) {
    float wrapped = wrapped_cosine(dot(s.n_world, to_light_world));
    vec3 scattered = wrapped + scatter_color_linear * terminator_bump(wrapped);
    return scattered * visibility;
}

// Legendre moments of the wrapped cosine, w in 0..1: 2 pi times the integral of f(t) P_l(t) over t in -w..1 is pi,
// pi (2 - w) / 3 and pi (1 - w)^2 / 4; at w = 0 they are Lambert's.
vec3 ambient_response(Surface s) {
    float band_1 = kPi * (2.0 - wrap) / 3.0;
    float band_2 = kPi * (1.0 - wrap) * (1.0 - wrap) / 4.0;
    return environment_convolved(s.n_world, vec3(kPi), vec3(band_1), vec3(band_2)) * s.occlusion;
}
