#version 460
#extension GL_GOOGLE_include_directive : require
// Step 3 of the source: one pass of the blur. Its radius varies from texel to texel with the kernel size in alpha.
#include "shared/frame.glsl"

layout(set = 0, binding = 1, scalar) uniform Params {
    float blur_scale;
    float blur_bias;
};
layout(set = 0, binding = 21) uniform texture2D source;
layout(push_constant, scalar) uniform PassValues { float pass_index; };

const int kPoisson = 0, kGaussian = 1, kBox = 2, kKawase = 3;
layout(constant_id = 0) const int blur_filter = kPoisson;
const int kDilateOff = 0, kDilateSource = 1, kDilateWrittenOnly = 2;
layout(constant_id = 1) const int dilate = kDilateWrittenOnly;

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 light_out;

// The twelve points of a Poisson disk that the source lists; the centre is the thirteenth tap.
const vec2 kPoissonDisk[12] =
    vec2[](vec2(-0.326212, -0.40581), vec2(-0.840144, -0.07358), vec2(-0.695914, 0.457137), vec2(-0.203345, 0.620716),
           vec2(0.96234, -0.194983), vec2(0.473434, -0.480026), vec2(0.519456, 0.767022), vec2(0.185461, -0.893124),
           vec2(0.507431, 0.064425), vec2(0.89642, 0.412458), vec2(-0.32194, -0.932615), vec2(-0.791559, -0.59771));

int tap_count() { return blur_filter == kPoisson ? 12 : blur_filter == kKawase ? 4 : 8; }

// Offset in radii and weight of a tap around the centre.
vec3 tap(int i) {
    if (blur_filter == kPoisson) return vec3(kPoissonDisk[i], 1.0);
    // Kawase 2003: four diagonal taps, each pass further out.
    if (blur_filter == kKawase) return vec3(vec2((i & 1) * 2 - 1, (i & 2) - 1) * (0.5 + 0.5 * pass_index), 1.0);
    int cell = i < 4 ? i : i + 1;  // the eight cells around the middle of 3 x 3
    vec2 offset = vec2(cell % 3, cell / 3) - 1.0;
    // 1 2 1 in both axes, against a centre of 4.
    float weight = blur_filter == kGaussian ? (2.0 - abs(offset.x)) * (2.0 - abs(offset.y)) : 1.0;
    return vec3(offset, weight);
}

float centre_weight() { return blur_filter == kGaussian ? 4.0 : 1.0; }

void main() {
    vec2 texel = 1.0 / vec2(textureSize(sampler2D(source, linear_clamp), 0));
    vec4 centre = textureLod(sampler2D(source, nearest_clamp), uv, 0.0);
    vec2 radius = texel * (centre.a * blur_scale + blur_bias);

    vec4 lowest = centre;     // the tap with the smallest kernel: surely a written one, if any is
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
