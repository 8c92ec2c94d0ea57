#version 460
#extension GL_GOOGLE_include_directive : require
// Two steps on the surface as steps in the atlas (d'Eon, Luebke 2007 keep the stretch along u and v alone; a sheared
// UV layout needs both steps with both components). Their length in mm is kernel size * scale + bias.
#include "shaders/atlas/surface_frame.glsl"
#include "shaders/include/frame.glsl"

layout(location = 1) in vec3 n_world;
layout(location = 3) in vec2 uv;
layout(location = 11) in vec3 du_mm;
layout(location = 12) in vec3 dv_mm;
uniform sampler2D kernel_size_map;
layout(push_constant, scalar) uniform PassValues {
    float size;            // texels a side
    float kernel_scale;    // mm
    float kernel_bias;     // mm
    float longest_texels;  // of a step
};

layout(location = 0) out vec4 steps_out;
layout(location = 1) out vec4 normal_out;

const float kMinTexels = 1e-3;  // 0: no skin

// The step in UV whose image on the surface is `t_mm`: least squares through the first fundamental form.
vec2 uv_step(vec3 t_mm, float e, float f, float g, float determinant) {
    float u = dot(du_mm, t_mm), v = dot(dv_mm, t_mm);
    return vec2(g * u - f * v, e * v - f * u) / determinant;
}

vec2 limited(vec2 step_texels) {
    float l = length(step_texels);
    return step_texels * (clamp(l, kMinTexels, longest_texels) / max(l, 1e-20));
}

void main() {
    float e = dot(du_mm, du_mm), f = dot(du_mm, dv_mm), g = dot(dv_mm, dv_mm);
    float determinant = max(e * g - f * f, 1e-6 * e * g);
    float length_mm = texture(kernel_size_map, uv).r * kernel_scale + kernel_bias;
    normal_out = vec4(normalize(n_world), 1.0);
    vec3 t1, t2;
    frame_of(normal_out.xyz, t1, t2);
    if (!(determinant > 0.0)) {
        steps_out = vec4(kMinTexels, 0.0, 0.0, kMinTexels);
        return;
    }
    steps_out = vec4(limited(uv_step(t1, e, f, g, determinant) * (length_mm * size)),
                     limited(uv_step(t2, e, f, g, determinant) * (length_mm * size)));
}
