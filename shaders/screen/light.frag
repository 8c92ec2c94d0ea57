#version 460
#extension GL_GOOGLE_include_directive : require
// The diffuse light of the skin that the camera sees, and its distance. The targets are cleared to 0; alpha is 1
// where skin was written, so that a bilinear read gives the share of skin.
#include "shaders/include/half_floats.glsl"
#include "shaders/screen/light.glsl"
#include "shaders/screen/rays.glsl"

layout(location = 0) out vec4 light_out;  // exitance over albedo
layout(location = 1) out float z_out_mm;  // along the camera's axis
layout(location = 2) out float key_visibility_out;

void main() {
    Surface s = load_surface();
    vec3 forward = normalize(toward(vec2(0.0)));
    light_out = half_rounded(vec4(unblurred_exitance(s, key_visibility_out), 1.0));
    z_out_mm = dot(s.p_world_mm - eye_world_mm, forward);
}
