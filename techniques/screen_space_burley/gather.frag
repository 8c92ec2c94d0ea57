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
    Disk disk = disk_here();
    vec3 gathered = light_around(disk, middle.rgb, sample_count);
    light_out = show_count == 1 ? vec4(vec3(kPi), 1.0) : gathered_out(disk, middle.rgb, gathered);
}
