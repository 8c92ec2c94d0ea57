#version 460
#extension GL_GOOGLE_include_directive : require
// The scattered light of a point, from as many samples as the variance around it asks for. pixel_turn() is even over 3 x 3
// texels of the pilot, so that their samples together are a larger set of samples of nearly the same disk. They are not
// used again: a spiral whose count is known converges faster than one to which samples are added.
#include "techniques/screen_space_burley/constants.h"
#include "techniques/screen_space_burley/gather.glsl"

uniform texture2D pilot;

layout(constant_id = 12) const int show_count = 0;
layout(push_constant, scalar) uniform PassValues { float noise; };

layout(location = 0) out vec4 light_out;

// The count for which the standard deviation is `noise` times the brightest light that is within reach.
int wanted_samples() {
    ivec2 last = textureSize(sampler2D(pilot, nearest_clamp), 0) - 1, texel = ivec2(gl_FragCoord.xy) / 2;
    float variance = 0.0, texels = 0.0, brightest = 0.0;
    for (int i = 0; i < 9; ++i) {
        vec3 other = texelFetch(sampler2D(pilot, nearest_clamp), clamp(texel + ivec2(i % 3 - 1, i / 3 - 1), ivec2(0), last), 0).rgb;
        variance += other.r;
        brightest = max(brightest, other.g);
        texels += other.b;
    }
    if (texels == 0.0) return sample_count;
    float allowed = noise * brightest;
    float wanted = pow(variance / texels / max(allowed * allowed, 1e-20), 1.0 / kConvergence);
    return int(ceil(clamp(wanted, float(min(kFewestSamples, sample_count)), float(sample_count))));
}

void main() {
    vec4 middle = textureLod(sampler2D(light, nearest_clamp), uv, 0.0);
    if (middle.a == 0.0) {
        light_out = vec4(0.0);
        return;
    }
    int count = wanted_samples();
    Disk disk = disk_here();
    vec3 gathered = light_around(disk, middle.rgb, count);
    light_out = show_count == 1 ? vec4(vec3(kPi * float(count) / float(sample_count)), 1.0) : gathered_out(disk, middle.rgb, gathered);
}
