#version 460
#extension GL_GOOGLE_include_directive : require
// Lambert: light leaves where it entered. No scattering; the baseline that every technique is compared with.
#include "shaders/include/forward.glsl"

vec3 direct_response(Surface s, vec3 to_light_world) {
    return vec3(max(dot(s.n_world, to_light_world), 0.0));
}

vec3 ambient_response(Surface s) { return environment_irradiance(s.n_world) * s.occlusion; }
