#version 460
#extension GL_GOOGLE_include_directive : require
// A few samples for each 2 x 2 pixels, and the variance of a sample that they show (Xie, Olano, Karis, Narkowicz 2020).
#include "techniques/screen_space_burley/gather.glsl"

layout(location = 0) out vec4 pilot_out;  // variance of the light, the brightest sample, whether there is skin

void main() {
    pilot_out = vec4(0.0);
    if (textureLod(sampler2D(light, nearest_clamp), uv, 0.0).a == 0.0) return;
    Disk disk = disk_here();
    Gathered g = gather(disk, sample_count);
    // Of the mean sum w l / sum w: sum w^2 (l - mean)^2 / (sum w)^2, times the count for one sample, without bias.
    float weights = dot(g.weights, vec3(1.0 / 3.0)), mean = dot(g.sum, vec3(1.0 / 3.0)) / max(weights, 1e-6);
    float squares = max(g.moments.z - mean * (2.0 * g.moments.y - mean * g.moments.x), 0.0);
    float outside = 1.0 - disk.inside.a, n = float(sample_count);
    float variance = outside * outside * squares / max(weights * weights, 1e-12) * n * n / (n - 1.0);
    pilot_out = vec4(variance, g.brightest, 1.0, 0.0);
}
