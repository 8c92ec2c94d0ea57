#version 460
#extension GL_GOOGLE_include_directive : require
// Step 3 of the source: one pass of a blur in texels, with one of the four filters that it compares. Its radius varies from
// texel to texel with the kernel size in alpha.
#include "shaders/atlas/written.glsl"
#include "techniques/texture_space/constants.h"

uniform texture2D source;

layout(push_constant, scalar) uniform PassValues {
    float kernel_scale;  // radius in texels: kernel size * scale + bias
    float kernel_bias;
    float pass_index;
    float share;         // of the light that the taps replace
};

layout(constant_id = 0) const int blur_filter = kFilterPoisson;
layout(constant_id = 1) const int dilate = kDilateWrittenOnly;

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 light_out;

// The twelve points of a Poisson disk that the source lists. Their mean is not 0, so that every pass moves the light.
const vec2 kPoissonDisk[12] =
    vec2[](vec2(-0.326212, -0.40581), vec2(-0.840144, -0.07358), vec2(-0.695914, 0.457137), vec2(-0.203345, 0.620716),
           vec2(0.96234, -0.194983), vec2(0.473434, -0.480026), vec2(0.519456, 0.767022), vec2(0.185461, -0.893124),
           vec2(0.507431, 0.064425), vec2(0.89642, 0.412458), vec2(-0.32194, -0.932615), vec2(-0.791559, -0.59771));

int tap_count() { return blur_filter == kFilterPoisson ? 12 : blur_filter == kFilterKawase ? 4 : 8; }

// Offset in radii and weight of a tap around the centre; the weights sum to 1.
vec3 tap(int i) {
    if (blur_filter == kFilterPoisson) return vec3(kPoissonDisk[i], 1.0 / 12.0);
    // Kawase 2003: four diagonal taps half a texel off, each pass a texel further out.
    if (blur_filter == kFilterKawase) return vec3(vec2((i & 1) * 2 - 1, (i & 2) - 1) * (0.5 + pass_index), 0.25);
    return ring_tap(i, blur_filter == kFilterGaussian);
}

// Unwritten texels are black, so a bilinear tap is its mean over written texels times their share.
vec4 average_of_written(vec4 centre, vec2 radius_uv) {
    if (centre.a == kUnwritten) return vec4(vec3(0.0), kUnwritten);
    vec3 sum = centre.rgb * (1.0 - share);
    float weight = 1.0 - share;
    for (int i = 0; i < tap_count(); ++i) {
        vec3 t = tap(i);
        vec4 light = light_and_coverage(source, uv + t.xy * radius_uv);
        sum += light.rgb * t.z * share;
        weight += light.a * t.z * share;
    }
    return vec4(weight > 1e-6 ? sum / weight : centre.rgb, centre.a);
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
    vec2 radius_uv = texel * (centre.a * kernel_scale + kernel_bias);
    light_out = dilate == kDilateWrittenOnly ? average_of_written(centre, radius_uv)
                                             : average_of_all(centre, radius_uv, dilate == kDilateSource);
}
