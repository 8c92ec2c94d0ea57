#version 460
#extension GL_GOOGLE_include_directive : require
// Step 3 of the source: one pass of the blur. Its radius varies from texel to texel with the kernel size in alpha.
#include "shaders/atlas/written.glsl"
#include "techniques/texture_space/taps.glsl"

uniform texture2D source;

layout(constant_id = 1) const int dilate = kDilateWrittenOnly;

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 light_out;

// Unwritten texels hold no light, so that a bilinear tap is premultiplied by the share of it that was written.
vec4 average_of_written(vec4 centre, vec2 radius_uv) {
    if (centre.a == kUnwritten) return vec4(vec3(0.0), kUnwritten);
    vec3 sum = centre.rgb * (1.0 - share), weight = 1.0 - share;
    for (int i = 0; i < tap_count(); ++i) {
        vec3 t = tap(i);
        vec4 light = light_and_coverage(source, uv + t.xy * radius_uv);
        sum += light.rgb * t.z * share;
        weight += light.a * t.z * share;
    }
    return vec4(mix(centre.rgb, sum / max(weight, vec3(1e-6)), greaterThan(weight, vec3(1e-6))), centre.a);
}

// The source's own: every tap counts, and with copy_lowest a texel whose taps find one that was never written becomes the
// tap with the smallest kernel, which was written.
vec4 average_of_all(vec4 centre, vec2 radius_uv, bool copy_lowest) {
    vec4 lowest = centre;
    float flag = centre.a;
    vec3 sum = centre.rgb * (1.0 - share);
    for (int i = 0; i < tap_count(); ++i) {
        vec3 t = tap(i);
        vec4 light = textureLod(sampler2D(source, linear_clamp), uv + t.xy * radius_uv, 0.0);
        flag = max(flag, light.a);
        if (light.a < lowest.a) lowest = light;
        sum += light.rgb * t.z * share;
    }
    return copy_lowest && flag == kUnwritten ? vec4(lowest.rgb, kUnwritten) : vec4(sum, centre.a);
}

void main() {
    vec2 texel = 1.0 / vec2(textureSize(sampler2D(source, linear_clamp), 0));
    vec4 centre = textureLod(sampler2D(source, nearest_clamp), uv, 0.0);
    vec2 radius_uv = texel * radius * (blur_filter == kFilterKawase ? 1.0 : centre.a * kernel_scale + kernel_bias);
    light_out = dilate == kDilateWrittenOnly ? average_of_written(centre, radius_uv)
                                             : average_of_all(centre, radius_uv, dilate == kDilateSource);
}
