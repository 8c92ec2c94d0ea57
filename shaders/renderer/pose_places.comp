#version 460
#extension GL_GOOGLE_include_directive : require
// Morph targets, then skins: where each place is, with and without the targets that turn normals.
#include "shaders/renderer/pose.glsl"

layout(scalar) readonly buffer Places { Place places[]; };
layout(scalar) readonly buffer Changes { vec3 changes[]; };
layout(scalar) writeonly buffer Positions { vec3 positions_mm[]; };
layout(scalar) writeonly buffer Unmorphed { vec3 unmorphed_mm[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= positions_mm.length()) return;
    vec3 p = places[i].position, before = p;
    uint end = targets[gl_WorkGroupID.x + 1].first;
    for (uint k = targets[gl_WorkGroupID.x].first; k < end; ++k) {
        vec3 change = changes[targets[k].first + gl_LocalInvocationID.x];
        p += targets[k].weight * change;
        before += targets[k].weight_before * change;
    }
    Blended to_mm = blended(places[i].influences);
    vec4 q = vec4(before, 1.0), m = vec4(p, 1.0);
    positions_mm[i] = vec3(dot(to_mm.x, m), dot(to_mm.y, m), dot(to_mm.z, m));
    unmorphed_mm[i] = vec3(dot(to_mm.x, q), dot(to_mm.y, q), dot(to_mm.z, q));
}
