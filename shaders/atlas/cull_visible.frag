#version 460
#extension GL_GOOGLE_include_directive : require
// Marks the texels whose point of the surface may be seen: inside the view frustum, and not facing away. Nothing is
// written elsewhere, so that where UVs overlap one visible point is enough.
#include "shaders/atlas/constants.h"
#include "shaders/include/frame.glsl"

layout(location = 0) in vec3 p_world_mm;
layout(location = 1) in vec3 n_world;
layout(location = 3) in vec2 uv;

layout(constant_id = 0) const int cull_frustum = 0;
layout(constant_id = 1) const int cull_back_face = 0;
layout(constant_id = 2) const int keep_thin = 0;

uniform sampler2D kernel_size_map;

layout(location = 0) out vec4 visible_out;

void main() {
    vec4 p_clip = view_projection * vec4(p_world_mm, 1.0);
    // Two texels of margin: a texel is also needed for points beside its centre, however close the camera is.
    vec3 margin = 2.0 * fwidth(p_clip.xyw);
    bool in_view = all(lessThanEqual(abs(p_clip.xy), vec2(p_clip.w) + margin.xy + margin.z));
    vec3 to_eye = normalize(eye_world_mm - p_world_mm);
    bool facing = dot(to_eye, normalize(n_world)) + kCullBias > 0.0;
    if (keep_thin != 0) facing = facing || texture(kernel_size_map, uv).r > kThinKernel;
    if ((cull_frustum != 0 && !in_view) || (cull_back_face != 0 && !facing)) discard;
    visible_out = vec4(1.0);
}
