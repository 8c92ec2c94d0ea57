#version 460
#extension GL_GOOGLE_include_directive : require
// The diffuse light of every point of the skin, at its place in the atlas (Gosselin, Sander, Mitchell 2004, step 2). In
// texels alpha is the size of the blur there and the target is cleared to 1, which no written texel has; in millimetres
// alpha is 1 where skin was written, the target is cleared to 0, and the size is in the atlas's metric.
#include "shaders/include/half_floats.glsl"
#include "shaders/atlas/light.glsl"

uniform sampler2D kernel_size_map;

layout(constant_id = 12) const int space = kSpaceTexels;

layout(push_constant, scalar) uniform PassValues {
    float pre_scatter;  // share of the base colour, as an exponent, that the light takes here
};

layout(location = 0) out vec4 light_out;  // exitance over albedo

const float kLargestWritten = 254.0 / 255.0;

// Levels by which the camera reads maps coarser, where a pixel covers more than a texel. At one level of detail the map
// and the pixel have the same light, also where grazing light is clamped, and the map holds no waves that pixels skip.
float levels_to_the_pixel(Surface s) {
    const float kLeastCosine = 0.1;
    float texel_mm = max(length(dFdx(s.p_world_mm)), length(dFdy(s.p_world_mm)));
    float distance_mm = (view_projection * vec4(s.p_world_mm, 1.0)).w;
    float cosine = max(abs(dot(s.n_geometry_world, s.to_eye_world)), kLeastCosine);
    return max(log2(distance_mm * pixel_per_distance / (cosine * max(texel_mm, 1e-9))), 0.0);
}

vec3 direct_exitance(Surface s) {
    vec3 direct = vec3(0.0);
    [[unroll]] for (int i = 0; i < light_count; ++i) {
        LightSample light = sample_light(i, s.p_world_mm);
        float n_dot_l = dot(s.n_world, light.to_light_world);
        if (n_dot_l <= 0.0) continue;
        direct += arriving_irradiance(light, n_dot_l) * diffuse_entry(s, n_dot_l) * shadow_factor(i, passing(s, i, light.to_light_world));
    }
    return direct;
}

void main() {
    Surface s = load_surface();
    load_normal(s, levels_to_the_pixel(s));
    float kernel_size = texture(kernel_size_map, s.uv).r;
    vec3 exitance = unblurred_exitance(s, direct_exitance(s)).of_mean;
    if (pre_scatter > 0.0) exitance *= pow(s.albedo_linear, vec3(pre_scatter));
    light_out = half_rounded(vec4(exitance, space == kSpaceMm ? 1.0 : min(kernel_size, kLargestWritten)));
}
