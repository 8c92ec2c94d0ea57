// Arrays of the compute passes that pose a mesh (dermis/render/deformer.h).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shaders/include/posing.h"

layout(local_size_x = kPoseBlock) in;

// Vertices that move together in every pose share a place.
struct Place {
    vec3 position;    // at rest, in the units and the space of its primitive
    uint influences;  // kOneMatrix and its number, or the first of its list
};
// The first of a list has its length as `matrix`.
struct Influence {
    uint matrix;
    float share;
};
// A morph target whose weight is not 0, in a block that it moves. The first entries belong to the blocks and one more: `first` of
// the next one ends a block's list, `weight` is 0 where no normal turns with the surface.
struct ActiveTarget {
    uint first;                   // index of the block's first change
    float weight, weight_before;  // before: 0 unless it has normals, which then do not turn
};

layout(scalar) readonly buffer Targets { ActiveTarget targets[]; };
layout(scalar) readonly buffer Influences { Influence influences[]; };
layout(scalar) readonly buffer Matrices { vec4 rows[]; };  // three for each matrix

struct Blended {
    vec4 x, y, z;
};

Blended blended(uint list) {
    if ((list & kOneMatrix) != 0) {
        uint row = 3 * (list & ~kOneMatrix);
        return Blended(rows[row], rows[row + 1], rows[row + 2]);
    }
    Blended sum = Blended(vec4(0.0), vec4(0.0), vec4(0.0));
    uint end = list + 1 + influences[list].matrix;
    for (uint k = list + 1; k < end; ++k) {
        uint row = 3 * influences[k].matrix;
        float share = influences[k].share;
        sum.x += share * rows[row];
        sum.y += share * rows[row + 1];
        sum.z += share * rows[row + 2];
    }
    return sum;
}

vec3 unit(vec3 v) {
    float size = length(v);
    return size > 1e-30 ? v / size : vec3(0.0);
}
