#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The irradiance of every vertex of a mesh, on its own normal, past shadows.
#include "shaders/include/environment.glsl"
#include "shaders/include/lights.glsl"
#include "shaders/include/shadow.glsl"
#include "shaders/renderer/linking.h"

layout(local_size_x = kLinkBlock) in;

layout(push_constant, scalar) uniform PassValues {
    int first_vertex, vertices;
};
layout(scalar) readonly buffer PositionStream { vec3 positions_mm[]; };
layout(scalar) readonly buffer NormalStream { vec3 normals[]; };
layout(scalar) readonly buffer OcclusionStream { float occlusions[]; };
layout(scalar) writeonly buffer Entering { EnteringLight entering[]; };

void main() {
    uint v = gl_GlobalInvocationID.x;
    if (v >= uint(vertices)) return;
    vec3 p_world_mm = positions_mm[v], n_world = normals[v];
    vec3 irradiance = environment_irradiance(n_world) * occlusions[v];
    for (int i = 0; i < light_count; ++i) {
        LightSample light = sample_light(i, p_world_mm);
        float n_dot_l = dot(n_world, light.to_light_world);
        if (n_dot_l <= 0.0) continue;
        LightThrough through = light_through(i, p_world_mm, n_world, light.to_light_world, penumbra_mm);
        irradiance += light.irradiance_linear * n_dot_l * through.visibility * through.tint;
    }
    irradiance = min(irradiance, vec3(65504.0));
    entering[uint(first_vertex) + v] = EnteringLight(packHalf2x16(irradiance.rg), packHalf2x16(vec2(irradiance.b, 0.0)));
}
