#version 460
#extension GL_GOOGLE_include_directive : require
// The background: a colour that falls off towards the corners like a studio's backdrop, or the environment.
#include "shaders/include/environment.glsl"

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 radiance_out;

void main() {
    vec4 p_far = inverse_view_projection * vec4(uv * 2.0 - 1.0, 1.0, 1.0);
    vec3 d_world = normalize(p_far.xyz / p_far.w - eye_world_mm);
    vec3 radiance = background_linear;
    if (environment_visible != 0)
        radiance = textureLod(samplerCube(environment_cube, trilinear_clamp), to_environment(d_world), 0.0).rgb *
                   environment_intensity;
    radiance_out = vec4(radiance, 0.0);
}
