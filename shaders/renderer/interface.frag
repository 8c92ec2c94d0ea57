#version 460
// sRGB-encoded colours, blended as they are: what the interface library expects.
uniform sampler linear_clamp;
uniform texture2D glyphs;

layout(location = 0) in vec2 glyph_uv;
layout(location = 1) in vec4 tint;
layout(location = 0) out vec4 window_out;

void main() { window_out = tint * texture(sampler2D(glyphs, linear_clamp), glyph_uv); }
