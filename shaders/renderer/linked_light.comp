#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What the links of every vertex bring. The threads of a vertex take every kLinkLanes-th link.
#include "shaders/renderer/linking.h"

layout(local_size_x = kLinkBlock) in;

layout(push_constant, scalar) uniform PassValues {
    int first_vertex, vertices;
};
struct Row {
    uint first, count;
    float scale;  // of the weights
};
layout(scalar) readonly buffer Rows { Row rows[]; };
struct Link {
    uint vertex, weights;
};
layout(scalar) readonly buffer Links { Link links[]; };
layout(scalar) readonly buffer Entering { EnteringLight entering[]; };
layout(scalar) writeonly buffer LinkedStream { vec3 linked[]; };

shared vec3 sums[kLinkBlock];

vec3 weights_of(uint bits) {
    int packed = int(bits);
    return vec3(bitfieldExtract(packed, 0, int(kLinkBits0)), bitfieldExtract(packed, int(kLinkBits0), int(kLinkBits1)),
                bitfieldExtract(packed, int(kLinkBits0 + kLinkBits1), int(kLinkBits2))) /
           vec3((1u << (kLinkBits0 - 1u)) - 1u, (1u << (kLinkBits1 - 1u)) - 1u, (1u << (kLinkBits2 - 1u)) - 1u);
}

void main() {
    uint v = gl_GlobalInvocationID.x / kLinkLanes, lane = gl_LocalInvocationID.x % kLinkLanes;
    Row row = Row(0u, 0u, 0.0);
    if (v < uint(vertices)) row = rows[uint(first_vertex) + v];
    vec3 sum = vec3(0.0);
    for (uint k = lane; k < row.count; k += kLinkLanes) {
        Link link = links[row.first + k];
        EnteringLight light = entering[link.vertex];
        sum += weights_of(link.weights) * vec3(unpackHalf2x16(light.red_green), unpackHalf2x16(light.blue).x);
    }
    sums[gl_LocalInvocationID.x] = sum;
    barrier();
    if (lane != 0u || v >= uint(vertices)) return;
    for (uint k = 1u; k < kLinkLanes; ++k) sum += sums[gl_LocalInvocationID.x + k];
    linked[v] = sum * row.scale;
}
