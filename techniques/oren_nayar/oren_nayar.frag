#version 460
#extension GL_GOOGLE_include_directive : require
// Oren, Nayar 1994, "Generalization of Lambert's reflectance model", equation 30 (the qualitative model).
#include "shaders/include/forward.glsl"

layout(scalar) uniform Params { float facet_sigma_rad; };

float facet_a() {
    float s2 = facet_sigma_rad * facet_sigma_rad;
    return 1.0 - 0.5 * s2 / (s2 + 0.33);
}

float facet_b() {
    float s2 = facet_sigma_rad * facet_sigma_rad;
    return 0.45 * s2 / (s2 + 0.09);
}

// L / L_Lambert = A + B max(0, cos dphi) sin a tan b, with a the larger and b the smaller of the polar angles.
vec3 direct_response(Surface s, vec3 to_light_world) {
    float n_dot_l = dot(s.n_world, to_light_world);
    if (n_dot_l <= 0.0) return vec3(0.0);
    float n_dot_v = clamp(dot(s.n_world, s.to_eye_world), 1e-3, 1.0);
    // cos dphi sin l sin v = l . v - (n . l)(n . v); then sin a tan b = sin l sin v / max(n . l, n . v).
    float cos_azimuth_sines = dot(to_light_world, s.to_eye_world) - n_dot_l * n_dot_v;
    float facets = max(cos_azimuth_sines, 0.0) / max(n_dot_l, n_dot_v);
    return vec3(n_dot_l * (facet_a() + facet_b() * facets));
}

// Light of equal radiance from all directions: the model integrated over the hemisphere of lights. With the eye at the polar angle v
//     int max(0, cos dphi) sin a tan b cos l dw = sin v (v - sin v cos v) + 2/3 tan v (1 - sin^3 v),
// the first term from lights nearer to the normal than the eye, the second from the others. Exact for a constant environment.
float even_light_response(float n_dot_v) {
    float sin_v = sqrt(1.0 - n_dot_v * n_dot_v);
    float above = sin_v * (acos(n_dot_v) - sin_v * n_dot_v);
    float below = 2.0 / 3.0 * sin_v / n_dot_v * (1.0 - sin_v * sin_v * sin_v);
    return facet_a() + facet_b() * (above + below) / kPi;
}

vec3 ambient_response(Surface s) {
    float n_dot_v = clamp(dot(s.n_world, s.to_eye_world), 1e-3, 1.0);
    return environment_irradiance(s.n_world) * s.occlusion * even_light_response(n_dot_v);
}
