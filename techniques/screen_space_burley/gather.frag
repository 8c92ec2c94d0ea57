#version 460
#extension GL_GOOGLE_include_directive : require
// The scattered light of a point, from samples of a disk around it (Golubev 2018). Samples are placed by the mean of the
// channels' radial densities, and weighted by each channel's own at the true distance between the points on the skin
// (bilateral filtering). The part of the profile within the pixel itself is computed, not sampled, and is
// the centre's weight, so that a profile far narrower than a pixel changes nothing.
#include "shaders/include/skin/table.glsl"
#include "shaders/screen/rays.glsl"

uniform texture2D light;
uniform texture2D skin_z;
// All over sqrt(. / reach) or u, both ends included; alpha is the mean of the channels.
uniform texture2D skin_density;  // row 0: 2 pi r R(r) / albedo in 1/mm; row 1: the part of the light within r
uniform texture2D skin_radius;   // the radius in mm within which the part u of the light leaves, in the mean

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

// A different rotation of the disk for each pixel, evenly distributed in any 3 x 3 block (Jimenez 2014, interleaved
// gradient noise).
float rotation(vec2 pixel) { return 2.0 * kPi * fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }

void main() {
    vec4 middle = textureLod(sampler2D(light, nearest_clamp), uv, 0.0);
    if (middle.a == 0.0) {
        light_out = vec4(0.0);
        return;
    }
    float z_mm = textureLod(sampler2D(skin_z, nearest_clamp), uv, 0.0).r;
    float reach_mm = radius_mm(1.0);
    PictureRays rays = picture_rays();
    vec3 p_mm = picture_point_mm(rays, uv, z_mm);
    vec2 size_mm = z_mm * vec2(length(rays.right), length(rays.down));  // of the picture at this depth
    vec2 pixel_mm = size_mm / vec2(textureSize(sampler2D(light, nearest_clamp), 0));
    float inner_mm = min(sqrt(pixel_mm.x * pixel_mm.y / kPi), reach_mm);  // the disk of a pixel's area
    vec4 inside = density_row(inner_mm, reach_mm, 1.0);
    float start = rotate == 1 ? rotation(gl_FragCoord.xy) : 0.0;

    vec3 sum = vec3(0.0), weights = vec3(0.0);
    for (int i = 0; i < sample_count; ++i) {
        float u = mix(inside.a, 1.0, (float(i) + 0.5) / float(sample_count));
        float r_mm = max(radius_mm(u), inner_mm);
        float angle = start + float(i) * kGoldenAngle;
        vec2 tap_uv = uv + r_mm * vec2(cos(angle), sin(angle)) / size_mm;
        vec4 tap = textureLod(sampler2D(light, linear_clamp), tap_uv, 0.0);
        if (tap.a < 1e-3) continue;
        float tap_z_mm = textureLod(sampler2D(skin_z, linear_clamp), tap_uv, 0.0).r / tap.a;
        float d_mm = max(distance(picture_point_mm(rays, tap_uv, tap_z_mm), p_mm), 1e-3);
        // Density over area at the true distance, over that of the sampling.
        vec3 weight = density_row(d_mm, reach_mm, 0.0).rgb / max(density_row(r_mm, reach_mm, 0.0).a, 1e-6);
        weight *= tap.a * step(d_mm, reach_mm);
        sum += weight * tap.rgb / tap.a;
        weights += weight;
    }
    // The samples share what is not inside the pixel.
    vec3 outside = step(vec3(1e-6), weights) * (1.0 - inside.rgb);
    light_out = vec4((inside.rgb * middle.rgb + outside * sum / max(weights, vec3(1e-6))) / (inside.rgb + outside), 1.0);
}
