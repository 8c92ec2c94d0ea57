#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// One direction of the blur. Taps lie at squared steps, dense in the middle (Jimenez et al. 2015, section 6). Each tap
// represents the cell that ends half way to its neighbours. Its weight is the difference of the kernel's cumulative
// function at the ends of the cell, so Gaussians much narrower than a pixel keep their whole weight. Distances are between
// the points on the skin: a cell on a slope is longer than its projection, and a tap behind a gap is too far away to count.
#include "shaders/include/half_floats.glsl"
#include "shaders/include/skin/table.glsl"
#include "shaders/screen/rays.glsl"
#include "techniques/screen_space_separable/constants.h"

uniform texture2D light;
uniform texture2D skin_z;
uniform texture2D skin_kernel;  // the light within a distance on both sides, over sqrt(distance / reach)

layout(constant_id = 10) const int half_taps = 8;
layout(constant_id = 11) const int along_v = 0;
layout(constant_id = 12) const int follow = kFollowSurface;

layout(push_constant, scalar) uniform PassValues { float reach_mm; };

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 light_out;

vec3 share_within(float distance_mm) {
    float size = float(textureSize(sampler2D(skin_kernel, linear_clamp), 0).x);
    float u = texel_centres(sqrt(clamp(distance_mm / reach_mm, 0.0, 1.0)), size);
    return textureLod(sampler2D(skin_kernel, linear_clamp), vec2(u, 0.5), 0.0).rgb;
}

// In mm on the picture's plane through the point; i from 0 to half_taps.
float tap_mm(float i) { return reach_mm * (i / float(half_taps)) * (i / float(half_taps)); }

void main() {
    light_out = vec4(0.0);
    vec4 middle = textureLod(sampler2D(light, nearest_clamp), uv, 0.0);
    if (middle.a == 0.0) return;
    float z_mm = textureLod(sampler2D(skin_z, nearest_clamp), uv, 0.0).r;
    PictureRays rays = picture_rays();
    vec3 p_mm = picture_point_mm(rays, uv, z_mm);
    vec2 uv_per_mm = along_v == 0 ? vec2(1.0 / (z_mm * length(rays.right)), 0.0)
                                  : vec2(0.0, 1.0 / (z_mm * length(rays.down)));
    vec3 blurred = vec3(0.0), weights = vec3(0.0);
    float middle_stretch = 1e9;
    [[unroll]] for (int side = -1; side <= 1; side += 2)
        for (int i = 1; i <= half_taps; ++i) {
            float offset_mm = tap_mm(float(i));
            vec2 tap_uv = uv + float(side) * offset_mm * uv_per_mm;
            vec4 tap = textureLod(sampler2D(light, linear_clamp), tap_uv, 0.0);
            if (tap.a < 1e-3) continue;
            float stretch = 1.0;  // mm on the skin per mm on the picture
            if (follow == kFollowSurface) {
                float tap_z_mm = textureLod(sampler2D(skin_z, linear_clamp), tap_uv, 0.0).r / tap.a;
                stretch = distance(picture_point_mm(rays, tap_uv, tap_z_mm), p_mm) / offset_mm;
            }
            if (i == 1) middle_stretch = min(middle_stretch, stretch);
            float begin_mm = 0.5 * (tap_mm(float(i - 1)) + offset_mm);
            float end_mm = i == half_taps ? offset_mm : 0.5 * (offset_mm + tap_mm(float(i + 1)));
            vec3 weight = 0.5 * tap.a * (share_within(end_mm * stretch) - share_within(begin_mm * stretch));
            blurred += weight * tap.rgb / tap.a;
            weights += weight;
        }
    if (middle_stretch > 1e8) middle_stretch = 1.0;
    vec3 weight = share_within(0.5 * tap_mm(1.0) * middle_stretch);
    blurred += weight * middle.rgb;
    weights += weight;
    // What lies behind a silhouette or a gap is assumed to be like what is seen.
    blurred += (share_within(reach_mm) - weights) * blurred / max(weights, vec3(1e-6));
    light_out = half_rounded(vec4(blurred, 1.0));
}
