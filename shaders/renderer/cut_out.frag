#version 460
#extension GL_GOOGLE_include_directive : require
// Depth alone, for shadow maps of scenes with cut-outs.
#include "shaders/include/cut_out.glsl"

void main() {
    if (cut_out()) discard;
}
