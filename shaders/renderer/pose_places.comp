#version 460
#extension GL_GOOGLE_include_directive : require
// Morph targets, then skins: where each place is, with and without the targets that turn normals. A target has changes for whole
// blocks of places, in which some place moves.
#include "shaders/renderer/pose.glsl"

layout(scalar) readonly buffer Places { Place places[]; };
layout(scalar) readonly buffer Blocks { uint first_changes[]; };  // by target, then block; kNoBlock
layout(scalar) readonly buffer Changes { vec3 changes[]; };
layout(scalar) readonly buffer Influences { Influence influences[]; };
layout(scalar) readonly buffer Targets { ActiveTarget targets[]; };
layout(scalar) readonly buffer Matrices { vec4 rows[]; };  // three for each matrix
layout(scalar) writeonly buffer Positions { vec3 positions_mm[]; };
layout(scalar) writeonly buffer Unmorphed { vec3 unmorphed_mm[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= positions_mm.length()) return;
    vec3 p = places[i].position, before = p;
    uint blocks = (positions_mm.length() + kPoseBlock - 1) / kPoseBlock;
    for (uint k = 0; k < targets.length(); ++k) {
        uint first = first_changes[targets[k].target * blocks + gl_WorkGroupID.x];
        if (first == kNoBlock) continue;
        vec3 change = changes[first + gl_LocalInvocationID.x];
        p += targets[k].weight * change;
        before += targets[k].weight_before * change;
    }
    vec4 x = vec4(0.0), y = vec4(0.0), z = vec4(0.0);
    uint end = places[i + 1].first_influence;
    for (uint k = places[i].first_influence; k < end; ++k) {
        uint row = 3 * influences[k].matrix;
        float share = influences[k].share;
        x += share * rows[row];
        y += share * rows[row + 1];
        z += share * rows[row + 2];
    }
    vec4 q = vec4(before, 1.0), m = vec4(p, 1.0);
    positions_mm[i] = vec3(dot(x, m), dot(y, m), dot(z, m));
    unmorphed_mm[i] = vec3(dot(x, q), dot(y, q), dot(z, q));
}
