#version 460
#extension GL_GOOGLE_include_directive : require
// Step 2 of the source: the diffuse light of every point of the surface, at its place in the atlas. Alpha is the size of
// the blur there; the target is cleared to 1, which no written texel has, so that the blur can tell charts from gutter.
#include "shared/environment.glsl"
#include "shared/lights.glsl"
#include "shared/shadow.glsl"
#include "shared/surface.glsl"

layout(set = 0, binding = 19) uniform texture2D kernel_size_map;

layout(location = 0) out vec4 light_out;  // exitance over albedo; kernel size

const float kLargestWritten = 254.0 / 255.0;

void main() {
    Surface s = load_surface();
    vec3 exitance = environment_irradiance(s.n_world) * s.occlusion;
    for (int i = 0; i < light_count; ++i) {
        LightSample light = sample_light(i, s.p_world_mm);
        float visibility = 1.0;
        if (i == key_light)
            visibility = shadow_visibility(s.p_world_mm, s.n_geometry_world, light.to_light_world, penumbra_mm);
        exitance += light.irradiance_linear * max(dot(s.n_world, light.to_light_world), 0.0) * visibility;
    }
    float kernel_size = texture(sampler2D(kernel_size_map, trilinear_repeat), s.uv).r;
    light_out = vec4(exitance, min(kernel_size, kLargestWritten));
}
