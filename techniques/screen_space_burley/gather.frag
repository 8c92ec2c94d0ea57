#version 460
#extension GL_GOOGLE_include_directive : require
// Gathers the light of a point from the samples of a disk around it (Golubev 2018). The samples are placed by the mean of
// the channels' radial densities. The weight of a sample is each channel's own density at the true distance between the
// points on the skin (bilateral filtering). The part of the profile within the pixel is computed, not sampled: it is the
// weight of the centre. So a profile that is far narrower than a pixel changes nothing.
#include "shaders/include/half_floats.glsl"
#include "shaders/include/pixel_turn.glsl"
#include "shaders/include/skin/table.glsl"
#include "shaders/screen/rays.glsl"

uniform texture2D light;
uniform texture2D skin_z;
// Both tables have texels at both ends of their range; alpha is the mean of the channels.
uniform texture2D skin_density;  // over sqrt(r / reach): row 0 is 2 pi r R(r) / albedo in 1/mm, row 1 the light within r
uniform texture2D skin_radius;   // over u: the radius in mm within which the part u of the light leaves, in the mean

layout(constant_id = 10) const int sample_count = 32;
layout(constant_id = 11) const int rotate = 1;

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 light_out;

vec4 density_row(float distance_mm, float reach_mm, float row) {
    float size = float(textureSize(sampler2D(skin_density, linear_clamp), 0).x);
    float u = texel_centres(sqrt(clamp(distance_mm / reach_mm, 0.0, 1.0)), size);
    return textureLod(sampler2D(skin_density, linear_clamp), vec2(u, (row + 0.5) / 2.0), 0.0);
}

float radius_mm(float part) {
    float u = texel_centres(part, float(textureSize(sampler2D(skin_radius, linear_clamp), 0).x));
    return textureLod(sampler2D(skin_radius, linear_clamp), vec2(u, 0.5), 0.0).r;
}

// Where samples are taken, and what is known about the pixel itself.
struct Disk {
    PictureRays rays;
    vec3 p_mm;
    vec2 size_mm;  // of the picture at this depth
    float reach_mm, inner_mm;
    vec4 inside;  // the part of the light that leaves within the pixel
};

Disk disk_here() {
    Disk disk;
    float z_mm = textureLod(sampler2D(skin_z, nearest_clamp), uv, 0.0).r;
    disk.reach_mm = radius_mm(1.0);
    disk.rays = picture_rays();
    disk.p_mm = picture_point_mm(disk.rays, uv, z_mm);
    disk.size_mm = z_mm * vec2(length(disk.rays.right), length(disk.rays.down));
    vec2 pixel_mm = disk.size_mm / vec2(textureSize(sampler2D(light, nearest_clamp), 0));
    disk.inner_mm = min(sqrt(pixel_mm.x * pixel_mm.y) / sqrt(kPi), disk.reach_mm);  // the disk of a pixel's area
    disk.inside = density_row(disk.inner_mm, disk.reach_mm, 1.0);
    return disk;
}

// The weighted mean of the samples; `middle` in channels where no sample hits skin.
vec3 light_around(Disk disk, vec3 middle) {
    vec3 sum = vec3(0.0), weights = vec3(0.0);
    float turn = rotate == 1 ? pixel_turn(gl_FragCoord.xy) : 0.0;
    for (int i = 0; i < sample_count; ++i) {
        float u = mix(disk.inside.a, 1.0, (float(i) + 0.5) / float(sample_count));
        float r_mm = max(radius_mm(u), disk.inner_mm);
        float angle = turn + float(i) * kGoldenAngle;
        vec2 tap_uv = uv + r_mm * vec2(cos(angle), sin(angle)) / disk.size_mm;
        vec4 tap = textureLod(sampler2D(light, linear_clamp), tap_uv, 0.0);
        if (tap.a < 1e-3) continue;
        float tap_z_mm = textureLod(sampler2D(skin_z, linear_clamp), tap_uv, 0.0).r / tap.a;
        float d_mm = max(distance(picture_point_mm(disk.rays, tap_uv, tap_z_mm), disk.p_mm), 1e-3);
        // The density over area at the true distance, over the density of the sampling.
        vec3 weight = density_row(d_mm, disk.reach_mm, 0.0).rgb / max(density_row(r_mm, disk.reach_mm, 0.0).a, 1e-6);
        weight *= tap.a * step(d_mm, disk.reach_mm);
        sum += weight * (tap.rgb / tap.a);
        weights += weight;
    }
    return mix(middle, sum / max(weights, vec3(1e-6)), step(vec3(1e-6), weights));
}

void main() {
    vec4 middle = textureLod(sampler2D(light, nearest_clamp), uv, 0.0);
    light_out = vec4(0.0);
    if (middle.a == 0.0) return;
    Disk disk = disk_here();
    light_out = half_rounded(vec4(mix(light_around(disk, middle.rgb), middle.rgb, disk.inside.rgb), 1.0));
}
