// Arrays of the compute passes that pose a mesh (dermis/render/deformer.h). A shader declares those it needs.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shaders/include/posing.h"

layout(local_size_x = kPoseBlock) in;

// Vertices that move together in every pose share a place.
struct Place {
    vec3 position;         // at rest, in the units and the space of its primitive
    uint first_influence;  // that of the next place ends the list
};
struct Influence {
    uint matrix;
    float share;
};
// A morph target whose weight is not 0.
struct ActiveTarget {
    uint target;
    float weight, weight_before;  // before: 0 unless it has normals, which then do not turn
};
struct MovingVertex {
    uint place;
    uint first_corner;  // that of the next vertex ends the list
    uint beside;        // a place that gives the frame a direction where the UVs have no area
    float rest_area;    // of the triangles around, at rest, twice, mm^2
    vec3 normal;        // of the file, in the space of its primitive; 0: none
    vec4 tangent;       // in the frame at rest, w as the mesh has it
    vec3 curvature_diagonal_per_mm, curvature_mixed_per_mm;  // in the frame at rest
};
// A triangle at a vertex: the places after and before the vertex's own. Bits of `next` say what it counts for.
struct Corner {
    uint next, previous;
};
// How UVs change over a corner's triangle: dP/du is edge_1 * du.x + edge_2 * du.y, edges to next and previous.
struct CornerSteps {
    vec2 direction;  // du of the file's UVs
    vec2 du, dv;     // of the atlas
};

vec3 unit(vec3 v) {
    float size = length(v);
    return size > 1e-30 ? v / size : vec3(0.0);
}
