#version 460
#extension GL_GOOGLE_include_directive : require
// The scattered light of a point, from as many samples at every pixel.
#include "techniques/screen_space_burley/gather.glsl"

layout(constant_id = 12) const int show_count = 0;

layout(location = 0) out vec4 light_out;

void main() {
    vec4 middle = textureLod(sampler2D(light, nearest_clamp), uv, 0.0);
    if (middle.a == 0.0) {
        light_out = vec4(0.0);
        return;
    }
    vec3 gathered = gathered_light(disk_here(), middle.rgb, sample_count);
    light_out = vec4(show_count == 1 ? vec3(kPi) : gathered, 1.0);
}
