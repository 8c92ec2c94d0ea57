#version 460
#extension GL_GOOGLE_include_directive : require
// The diffuse light of every point of the skin, at its place in the atlas (Gosselin, Sander, Mitchell 2004, step 2). In
// texels alpha is the size of the blur there and the target is cleared to 1, which no written texel has; in millimetres
// alpha is 1 where skin was written, the target is cleared to 0, and the size lies in the atlas's metric.
#include "shared/environment.glsl"
#include "shared/lights.glsl"
#include "shared/shadow_channels.glsl"
#include "shared/surface.glsl"

layout(set = 0, binding = 1, scalar) uniform Params {
    float occluded;            // of the light that is left in full shadow
    float trans_shadow_alpha;  // larger values make translucent shadows darker
};
layout(set = 0, binding = 19) uniform texture2D kernel_size_map;

const int kSpaceTexels = 0, kSpaceMm = 1;
layout(constant_id = 12) const int space = kSpaceTexels;

layout(location = 0) out vec4 light_out;  // exitance over albedo

const float kLargestWritten = 254.0 / 255.0;

vec3 shadow_factor(Surface s, int light, vec3 to_light_world) {
    vec3 through = vec3(1.0);
    if (light == key_light)
        through = key_light_through(s.p_world_mm, s.n_geometry_world, to_light_world, penumbra_mm, trans_shadow_alpha);
    else if (channels == kChannelsTwoLights && light == second_light)
        through =
            second_light_through(s.p_world_mm, s.n_geometry_world, to_light_world, penumbra_mm, trans_shadow_alpha);
    return mix(vec3(occluded), vec3(1.0), through);
}

void main() {
    Surface s = load_surface();
    vec3 exitance = environment_irradiance(s.n_world) * s.occlusion;
    for (int i = 0; i < light_count; ++i) {
        LightSample light = sample_light(i, s.p_world_mm);
        float n_dot_l = dot(s.n_world, light.to_light_world);
        if (n_dot_l > 0.0) exitance += light.irradiance_linear * n_dot_l * shadow_factor(s, i, light.to_light_world);
    }
    float kernel_size = texture(sampler2D(kernel_size_map, trilinear_repeat), s.uv).r;
    light_out = vec4(exitance, space == kSpaceMm ? 1.0 : min(kernel_size, kLargestWritten));
}
