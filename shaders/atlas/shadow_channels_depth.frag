#version 460
// Depth seen from a light as a colour; the pass's write mask picks the channel (Gosselin, Sander, Mitchell 2004: alpha).
layout(location = 0) out vec4 depth_out;

void main() { depth_out = vec4(gl_FragCoord.z); }
