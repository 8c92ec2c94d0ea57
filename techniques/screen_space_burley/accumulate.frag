#version 460
#extension GL_GOOGLE_include_directive : require
// The mean of this frame's samples and those of earlier frames at the same point of the skin, which the camera of
// the frame before saw elsewhere on the picture. Where it saw another surface there, the mean begins again. Where light has
// changed, what is kept is held within what this frame has around the pixel (variance clipping: Salvi 2016, "An Excursion
// in Temporal Supersampling").
#include "techniques/screen_space_burley/constants.h"
#include "techniques/screen_space_burley/gather.glsl"

uniform texture2D light_around_now;
uniform texture2D light_before;  // alpha: how many frames it is the mean of, 0 where there was no skin
uniform texture2D z_before;      // along the axis of the earlier camera

layout(push_constant, scalar) uniform PassValues { float light_changes; };  // 1 where it is not that of the frame before

layout(location = 0) out vec4 light_out;   // what the mesh is shaded with
layout(location = 1) out vec4 around_out;  // what the next frame reads
layout(location = 2) out float z_out_mm;

// Two depths are of one surface if they differ by less than this and as many pixels.
const float kSameSurfaceMm = 1.0, kSameSurfacePixels = 2.0;
// Standard deviations around the mean of 3 x 3 pixels.
const float kClip = 1.5;

// Where the frame before had the point, in pixels, and how far along its camera's axis; behind it, z is not positive.
vec3 place_before(vec3 p_world_mm) {
    vec4 p_clip = previous_view_projection * vec4(p_world_mm, 1.0);
    vec2 size = vec2(textureSize(sampler2D(z_before, nearest_clamp), 0));
    return vec3((p_clip.xy / p_clip.w * 0.5 + 0.5) * size - 0.5, p_clip.w);
}

// The mean that the frame before had there, and of how many frames; 0 where it saw another surface.
vec4 seen_before(vec3 place) {
    if (place.z <= 0.0) return vec4(0.0);
    ivec2 size = textureSize(sampler2D(z_before, nearest_clamp), 0);
    vec2 corner = floor(place.xy), part = place.xy - corner;
    float margin_mm = kSameSurfaceMm + kSameSurfacePixels * pixel_per_distance * place.z;
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1), pixel = ivec2(corner) + offset;
        if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, size))) continue;
        float z_mm = texelFetch(sampler2D(z_before, nearest_clamp), pixel, 0).r;
        if (z_mm == 0.0 || abs(z_mm - place.z) > margin_mm) continue;
        vec2 along = mix(1.0 - part, part, vec2(offset));
        sum += along.x * along.y * texelFetch(sampler2D(light_before, nearest_clamp), pixel, 0);
        weights += along.x * along.y;
    }
    return weights < 0.01 ? vec4(0.0) : sum / weights;
}

// Of the skin in 3 x 3 pixels: bounds of what this frame has, and its mean less that of the frame before.
struct Around {
    vec3 least, most, change;
};

Around look_around(vec3 now, vec2 place) {
    ivec2 last = textureSize(sampler2D(light_around_now, nearest_clamp), 0) - 1, there = ivec2(round(place));
    vec3 sum = vec3(0.0), squares = vec3(0.0), changes = vec3(0.0);
    float count = 0.0, seen = 0.0;
    for (int i = 0; i < 9; ++i) {
        ivec2 offset = ivec2(i % 3 - 1, i / 3 - 1);
        vec4 light = texelFetch(sampler2D(light_around_now, nearest_clamp), clamp(ivec2(gl_FragCoord.xy) + offset, ivec2(0), last), 0);
        vec4 before = texelFetch(sampler2D(light_before, nearest_clamp), clamp(there + offset, ivec2(0), last), 0);
        sum += light.a * light.rgb;
        squares += light.a * light.rgb * light.rgb;
        count += light.a;
        float both = light.a * float(before.a > 0.0);
        changes += both * (light.rgb - before.rgb);
        seen += both;
    }
    vec3 mean = sum / count, deviation = sqrt(max(squares / count - mean * mean, vec3(0.0)));
    return Around(min(now, mean - kClip * deviation), max(now, mean + kClip * deviation), changes / max(seen, 1.0));
}

vec4 accumulated(vec4 now) {
    if (earlier_frames == 0) return now;
    vec3 place = place_before(eye_world_mm + picture_point_mm(picture_rays(), uv, z_out_mm));
    vec4 before = seen_before(place);
    if (before.a == 0.0) return now;
    Around around = look_around(now.rgb, place.xy);
    // What has changed is the mean over 9 pixels' samples: noise of a third.
    vec3 kept = before.rgb + (light_changes > 0.0 ? around.change : vec3(0.0));
    float frames = min(before.a + 1.0, light_changes > 0.0 ? float(kFramesOfChangingLight) : float(kMostFrames));
    return vec4(mix(clamp(kept, around.least, around.most), now.rgb, 1.0 / frames), frames);
}

void main() {
    vec4 now = texelFetch(sampler2D(light_around_now, nearest_clamp), ivec2(gl_FragCoord.xy), 0);
    z_out_mm = texelFetch(sampler2D(skin_z, nearest_clamp), ivec2(gl_FragCoord.xy), 0).r;
    around_out = light_out = vec4(0.0);
    if (now.a == 0.0) return;
    around_out = accumulated(now);
    vec3 middle = texelFetch(sampler2D(light, nearest_clamp), ivec2(gl_FragCoord.xy), 0).rgb;
    light_out = half_rounded(vec4(gathered_light(disk_here(), middle, around_out.rgb), 1.0));
}
