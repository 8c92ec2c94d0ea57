#version 460
#extension GL_GOOGLE_include_directive : require
// Step 3 of the source: one pass of the blur. Its radius varies from texel to texel with the kernel size in alpha.
#include "shaders/include/frame.glsl"
#include "techniques/texture_space/taps.glsl"

layout(scalar) uniform Params {
    float blur_scale;
    float blur_bias;
};
uniform texture2D source;

layout(constant_id = 1) const int dilate = kDilateWrittenOnly;

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 light_out;

void main() {
    vec2 texel = 1.0 / vec2(textureSize(sampler2D(source, linear_clamp), 0));
    vec4 centre = textureLod(sampler2D(source, nearest_clamp), uv, 0.0);
    vec2 radius = texel * (centre.a * blur_scale + blur_bias);

    vec4 lowest = centre;     // the tap with the smallest kernel: a written one, if there is any
    float flag = centre.a;    // 1 as soon as one tap was never written
    bool count_all = dilate != kDilateWrittenOnly;
    float weight = count_all || centre.a < 1.0 ? centre_weight() : 0.0;
    vec3 sum = centre.rgb * weight;
    for (int i = 0; i < tap_count(); ++i) {
        vec3 t = tap(i);
        vec2 at = uv + t.xy * radius;
        vec4 light = count_all ? textureLod(sampler2D(source, linear_clamp), at, 0.0)
                               : textureLod(sampler2D(source, nearest_clamp), at, 0.0);
        flag = max(flag, light.a);
        if (light.a < lowest.a) lowest = light;
        float tap_weight = count_all || light.a < 1.0 ? t.z : 0.0;
        sum += light.rgb * tap_weight;
        weight += tap_weight;
    }
    vec3 blurred = weight > 0.0 ? sum / weight : centre.rgb;
    if (dilate == kDilateSource && flag == 1.0)
        light_out = vec4(lowest.rgb, 1.0);
    else
        light_out = vec4(blurred, centre.a);
}
