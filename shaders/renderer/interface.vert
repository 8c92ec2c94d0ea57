#version 460
// The interface's triangles, in pixels of the window.
layout(push_constant) uniform Push { vec2 window_px; };

layout(location = 0) in vec4 position_uv;
layout(location = 1) in vec4 color;
layout(location = 0) out vec2 glyph_uv;
layout(location = 1) out vec4 tint;

void main() {
    glyph_uv = position_uv.zw;
    tint = color;
    gl_Position = vec4(position_uv.xy / window_px * 2.0 - 1.0, 0.0, 1.0);
}
