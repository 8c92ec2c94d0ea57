#version 460
#extension GL_GOOGLE_include_directive : require
// Linear radiance to the sRGB-encoded picture.
#include "shaders/include/frame.glsl"
#include "shaders/renderer/tone_map.glsl"

uniform texture2D radiance;
layout(constant_id = 0) const int tone_map = kToneMapHable;

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 display_out;

void main() {
    vec4 color = texelFetch(sampler2D(radiance, nearest_clamp), ivec2(gl_FragCoord.xy), 0);
    display_out = vec4(srgb_encode(tone_mapped(max(color.rgb, vec3(0.0)) * exposure, tone_map)), 1.0);
}
