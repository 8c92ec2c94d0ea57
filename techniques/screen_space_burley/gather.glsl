// Samples of a disk around a point of the picture (Golubev 2018). They are placed by the mean of the channels' radial
// densities, and weighted by each channel's own at the true distance between the points on the skin (bilateral
// filtering). The part of the profile within the pixel itself is computed, not sampled, and is the centre's weight, so
// that a profile far narrower than a pixel changes nothing.
#ifndef DERMIS_BURLEY_GATHER_GLSL
#define DERMIS_BURLEY_GATHER_GLSL

#include "shaders/include/half_floats.glsl"
#include "shaders/include/pixel_turn.glsl"
#include "shaders/include/skin/table.glsl"
#include "shaders/screen/rays.glsl"

uniform texture2D light;
uniform texture2D skin_z;
// All over sqrt(. / reach) or u, both ends included; alpha is the mean of the channels.
uniform texture2D skin_density;  // row 0: 2 pi r R(r) / albedo in 1/mm; row 1: the part of the light within r
uniform texture2D skin_radius;   // the radius in mm within which the part u of the light leaves, in the mean

layout(constant_id = 10) const int sample_count = 32;
layout(constant_id = 11) const int rotate = 1;
layout(constant_id = 13) const int accumulate = 0;

layout(location = 0) in vec2 uv;

vec4 density_row(float distance_mm, float reach_mm, float row) {
    float size = float(textureSize(sampler2D(skin_density, linear_clamp), 0).x);
    float u = texel_centres(sqrt(clamp(distance_mm / reach_mm, 0.0, 1.0)), size);
    return textureLod(sampler2D(skin_density, linear_clamp), vec2(u, (row + 0.5) / 2.0), 0.0);
}

float radius_mm(float part) {
    float u = texel_centres(part, float(textureSize(sampler2D(skin_radius, linear_clamp), 0).x));
    return textureLod(sampler2D(skin_radius, linear_clamp), vec2(u, 0.5), 0.0).r;
}

// Where samples are taken, and what is known of the pixel itself.
struct Disk {
    PictureRays rays;
    vec3 p_mm;
    vec2 size_mm;  // of the picture at this depth
    float reach_mm, inner_mm, pixel_mm;
    vec4 inside;  // the part of the light that leaves within the pixel
    float turn;
    float first;  // where the first sample lies in its part of the light, 0 to 1
};

// Angle and radius of the samples of frame n: multiples of two numbers whose points fill the square evenly, however many
// there are (Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences"). Frame 0 has neither.
vec2 frame_shift() {
    if (accumulate == 0) return vec2(0.0);
    const float kPeriod = 4096.0;  // floats hold the products to 1/2048
    return fract(mod(float(earlier_frames), kPeriod) * vec2(0.75487766, 0.56984029));
}

Disk disk_here() {
    Disk disk;
    float z_mm = textureLod(sampler2D(skin_z, nearest_clamp), uv, 0.0).r;
    disk.reach_mm = radius_mm(1.0);
    disk.rays = picture_rays();
    disk.p_mm = picture_point_mm(disk.rays, uv, z_mm);
    disk.size_mm = z_mm * vec2(length(disk.rays.right), length(disk.rays.down));
    vec2 pixel_mm = disk.size_mm / vec2(textureSize(sampler2D(light, nearest_clamp), 0));
    disk.pixel_mm = sqrt(pixel_mm.x * pixel_mm.y);
    disk.inner_mm = min(disk.pixel_mm / sqrt(kPi), disk.reach_mm);  // the disk of a pixel's area
    disk.inside = density_row(disk.inner_mm, disk.reach_mm, 1.0);
    vec2 shift = frame_shift();
    disk.turn = (rotate == 1 ? pixel_turn(gl_FragCoord.xy) : 0.0) + 2.0 * kPi * shift.x;
    disk.first = fract(0.5 + shift.y);
    return disk;
}

// Sums over samples. The moments are of the channels' means, with squared weights: of order 0, 1, 2 in the light.
struct Gathered {
    vec3 sum, weights, moments;
    float brightest;
};

Gathered gather(Disk disk, int count) {
    Gathered g = Gathered(vec3(0.0), vec3(0.0), vec3(0.0), 0.0);
    for (int i = 0; i < count; ++i) {
        float u = mix(disk.inside.a, 1.0, (float(i) + disk.first) / float(count));
        float r_mm = max(radius_mm(u), disk.inner_mm);
        float angle = disk.turn + float(i) * kGoldenAngle;
        vec2 tap_uv = uv + r_mm * vec2(cos(angle), sin(angle)) / disk.size_mm;
        vec4 tap = textureLod(sampler2D(light, linear_clamp), tap_uv, 0.0);
        if (tap.a < 1e-3) continue;
        float tap_z_mm = textureLod(sampler2D(skin_z, linear_clamp), tap_uv, 0.0).r / tap.a;
        float d_mm = max(distance(picture_point_mm(disk.rays, tap_uv, tap_z_mm), disk.p_mm), 1e-3);
        // Density over area at the true distance, over that of the sampling.
        vec3 weight = density_row(d_mm, disk.reach_mm, 0.0).rgb / max(density_row(r_mm, disk.reach_mm, 0.0).a, 1e-6);
        weight *= tap.a * step(d_mm, disk.reach_mm);
        vec3 tap_light = tap.rgb / tap.a;
        g.sum += weight * tap_light;
        g.weights += weight;
        float mean_weight = dot(weight, vec3(1.0 / 3.0)), mean_light = dot(tap_light, vec3(1.0 / 3.0));
        g.moments += mean_weight * mean_weight * vec3(1.0, mean_light, mean_light * mean_light);
        g.brightest = max(g.brightest, mean_light);
    }
    return g;
}

// The mean of the samples; where none is of the skin, what is at the pixel.
vec3 light_around(Disk disk, vec3 middle, int count) {
    Gathered g = gather(disk, count);
    return mix(middle, g.sum / max(g.weights, vec3(1e-6)), step(vec3(1e-6), g.weights));
}

// The samples share what is not inside the pixel.
vec3 gathered_light(Disk disk, vec3 middle, vec3 around) { return mix(around, middle, disk.inside.rgb); }

// Over frames the samples are accumulated alone: what is at the pixel has no noise, and is not to be read elsewhere.
vec4 gathered_out(Disk disk, vec3 middle, vec3 around) {
    if (accumulate != 0) return vec4(around, 1.0);
    return half_rounded(vec4(gathered_light(disk, middle, around), 1.0));
}

#endif
