#version 460
#extension GL_GOOGLE_include_directive : require
// Oren, Nayar 1994, "Generalization of Lambert's reflectance model", equation 30 (the qualitative model).
#include "shaders/include/forward.glsl"

layout(scalar) uniform Params { float facet_sigma_rad; };

// A = 1 - .5 s^2 / (s^2 + .33), B = .45 s^2 / (s^2 + .09); L / L_Lambert = A + B max(0, cos dphi) sin a tan b, with a
// the larger and b the smaller of the polar angles.
vec3 direct_response(Surface s, vec3 to_light_world, float visibility) {
    float n_dot_l = dot(s.n_world, to_light_world);
    if (n_dot_l <= 0.0) return vec3(0.0);
    float n_dot_v = clamp(dot(s.n_world, s.to_eye_world), 1e-3, 1.0);
    float s2 = facet_sigma_rad * facet_sigma_rad;
    float a = 1.0 - 0.5 * s2 / (s2 + 0.33);
    float b = 0.45 * s2 / (s2 + 0.09);
    // cos dphi sin l sin v = l . v - (n . l)(n . v); then sin a tan b = sin l sin v / max(n . l, n . v).
    float cos_azimuth_sines = dot(to_light_world, s.to_eye_world) - n_dot_l * n_dot_v;
    float facets = max(cos_azimuth_sines, 0.0) / max(n_dot_l, n_dot_v);
    return vec3(n_dot_l * (a + b * facets) * visibility);
}

// Lambert's. The model itself, which leaves out reflections between facets, returns 92 % of even light from all around at
// the default sigma.
vec3 ambient_response(Surface s) { return environment_irradiance(s.n_world); }
