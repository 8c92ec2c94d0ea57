#version 460
#extension GL_GOOGLE_include_directive : require
// Two steps on the surface as steps in the atlas (d'Eon, Luebke 2007 keep the stretch along u and v alone; a sheared
// UV layout needs both steps with both components). Their length in mm is kernel size * scale + bias.
#include "shaders/include/frame.glsl"

layout(location = 1) in vec3 n_world;
layout(location = 3) in vec2 uv;
layout(location = 9) in vec3 du_mm;
layout(location = 10) in vec3 dv_mm;
uniform sampler2D kernel_size_map;
layout(push_constant, scalar) uniform PassValues {
    float size;            // texels a side
    float kernel_scale;    // mm
    float kernel_bias;     // mm
    float longest_texels;  // of a step
};

layout(location = 0) out vec4 steps_out;

const float kMinTexels = 1e-3;  // 0 means that no skin is there

// A tangent frame that depends on the normal alone (Frisvad 2012, with its hole at n = -y).
void frame_of(vec3 n, out vec3 t1, out vec3 t2) {
    float f = 1.0 / max(1.0 + n.y, 1e-3);
    t1 = vec3(1.0 - n.x * n.x * f, -n.x, -n.x * n.z * f);
    t2 = vec3(-n.x * n.z * f, -n.z, 1.0 - n.z * n.z * f);
}

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
    vec3 t1, t2;
    frame_of(normalize(n_world), t1, t2);
    if (!(determinant > 0.0)) {
        steps_out = vec4(kMinTexels, 0.0, 0.0, kMinTexels);
        return;
    }
    steps_out = vec4(limited(uv_step(t1, e, f, g, determinant) * (length_mm * size)),
                     limited(uv_step(t2, e, f, g, determinant) * (length_mm * size)));
}
