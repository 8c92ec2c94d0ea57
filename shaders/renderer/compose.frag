#version 460
#extension GL_GOOGLE_include_directive : require
// The pictures in their part of the window: one, two with a movable border between them, or two side by side.
#include "shaders/renderer/constants.h"

layout(push_constant) uniform Push {
    vec4 region_px;   // x, y, width, height
    vec4 frame_color; // around the pictures, sRGB-encoded
    vec2 window_px;
    float split;      // of the region's width, for the wipe
    float line_px;
    int mode;
};

uniform sampler linear_clamp;
uniform texture2D picture_a;
uniform texture2D picture_b;

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 window_out;

// Centred in a box, as large as its shape allows.
vec4 contained(texture2D picture, vec2 at, vec2 box_px) {
    vec2 size = vec2(textureSize(sampler2D(picture, linear_clamp), 0));
    vec2 shown_px = size * min(box_px.x / size.x, box_px.y / size.y);
    vec2 inside = (at - 0.5) * box_px / shown_px + 0.5;
    if (any(lessThan(inside, vec2(0.0))) || any(greaterThan(inside, vec2(1.0)))) return frame_color;
    return texture(sampler2D(picture, linear_clamp), inside);
}

void main() {
    vec2 at = (uv * window_px - region_px.xy) / region_px.zw;
    bool outside = any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, vec2(1.0)));
    window_out = frame_color;
    if (outside) return;
    float line_distance_px = abs(at.x - (mode == kArrangementWipe ? split : 0.5)) * region_px.z;
    if (mode == kArrangementOne) {
        window_out = contained(picture_a, at, region_px.zw);
    } else if (mode == kArrangementWipe) {
        window_out = at.x < split ? contained(picture_a, at, region_px.zw) : contained(picture_b, at, region_px.zw);
    } else {
        vec2 half_box = vec2(0.5, 1.0) * region_px.zw;
        window_out = at.x < 0.5 ? contained(picture_a, vec2(at.x * 2.0, at.y), half_box)
                                : contained(picture_b, vec2(at.x * 2.0 - 1.0, at.y), half_box);
    }
    if (mode != kArrangementOne && line_distance_px < line_px * 0.5) window_out = vec4(vec3(0.85), 1.0);
    window_out.a = 1.0;
}
