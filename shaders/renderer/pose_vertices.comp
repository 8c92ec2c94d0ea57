#version 460
#extension GL_GOOGLE_include_directive : require
// The streams of a mesh from its places, by one walk over the triangles around each vertex: the file's normals
// turned as the surface turns, tangents and curvature turned with the frame of normal and dP/du, dP/du and dP/dv
// of the atlas, tension.
#include "shaders/renderer/pose.glsl"

layout(constant_id = 0) const int has_normal_changes = 0;

layout(scalar) readonly buffer NormalBlocks { uint first_normal_changes[]; };  // by target, then block of vertices
layout(scalar) readonly buffer NormalChanges { vec3 normal_changes[]; };
layout(scalar) readonly buffer Targets { ActiveTarget targets[]; };
layout(scalar) readonly buffer Vertices { MovingVertex vertices[]; };
layout(scalar) readonly buffer Corners { Corner corners[]; };
layout(scalar) readonly buffer Steps { CornerSteps steps[]; };
layout(scalar) readonly buffer Places { Place places[]; };
layout(scalar) readonly buffer Influences { Influence influences[]; };
layout(scalar) readonly buffer Matrices { vec4 rows[]; };
layout(scalar) readonly buffer Positions { vec3 positions_mm[]; };
layout(scalar) readonly buffer Unmorphed { vec3 unmorphed_mm[]; };
layout(scalar) writeonly buffer PositionStream { vec3 position_stream[]; };
layout(scalar) writeonly buffer NormalStream { vec3 normal_stream[]; };
layout(scalar) writeonly buffer TangentStream { vec4 tangent_stream[]; };
layout(scalar) writeonly buffer DiagonalStream { vec3 diagonal_stream[]; };
layout(scalar) writeonly buffer MixedStream { vec3 mixed_stream[]; };
layout(scalar) writeonly buffer DuStream { vec3 du_stream[]; };
layout(scalar) writeonly buffer DvStream { vec3 dv_stream[]; };
layout(scalar) writeonly buffer TensionStream { float tension_stream[]; };

// Sums over the triangles around a vertex.
struct Around {
    vec3 normal_before, normal_after;  // face normals weighted by angle (dermis/mesh/normals.h), at the end unit
    vec3 direction, du, dv;            // weighted by area (dermis/mesh/uv_report.h)
    float uv_area, area;               // twice
};

// The face normal between two edges times their angle.
vec3 weighted_normal(vec3 a, vec3 b) {
    vec3 n = cross(a, b);
    float size = length(n);
    return size > 0.0 ? n / size * atan(size, dot(a, b)) : vec3(0.0);
}

Around walk_around(uint place, uint first, uint end) {
    Around sum = Around(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0);
    vec3 p = positions_mm[place], q = unmorphed_mm[place], last_before = vec3(0.0), last_after = vec3(0.0);
    for (uint k = first; k < end; ++k) {
        Corner corner = corners[k];
        uint kind = corner.next & kCornerKinds, next = corner.next & ~kCornerKinds, previous = corner.previous;
        vec3 edge_1 = positions_mm[next] - p, edge_2 = positions_mm[previous] - p;
        if ((kind & kCornerJoined) != 0) {
            last_before = weighted_normal(unmorphed_mm[next] - q, unmorphed_mm[previous] - q);
            last_after = weighted_normal(edge_1, edge_2);
            sum.normal_before += last_before;
            sum.normal_after += last_after;
        }
        float area = length(cross(edge_1, edge_2));
        CornerSteps step = steps[k];
        sum.area += (kind & kCornerDrawn) != 0 ? area : 0.0;
        sum.direction += area * (edge_1 * step.direction.x + edge_2 * step.direction.y);
        sum.du += area * (edge_1 * step.du.x + edge_2 * step.du.y);
        sum.dv += area * (edge_1 * step.dv.x + edge_2 * step.dv.y);
        sum.uv_area += (kind & kCornerInAtlas) != 0 ? area : 0.0;
    }
    if (length(sum.normal_before) < kShortestNormalSum) sum.normal_before = last_before;
    if (length(sum.normal_after) < kShortestNormalSum) sum.normal_after = last_after;
    sum.normal_before = unit(sum.normal_before);
    sum.normal_after = unit(sum.normal_after);
    return sum;
}

// By the cofactors of the blended matrix: the inverse transpose up to a positive factor.
vec3 skinned_normal(uint place, vec3 n) {
    vec3 x = vec3(0.0), y = vec3(0.0), z = vec3(0.0);
    uint end = places[place + 1].first_influence;
    for (uint k = places[place].first_influence; k < end; ++k) {
        uint row = 3 * influences[k].matrix;
        float share = influences[k].share;
        x += share * rows[row].xyz;
        y += share * rows[row + 1].xyz;
        z += share * rows[row + 2].xyz;
    }
    vec3 yz = cross(y, z);
    return unit(vec3(dot(yz, n), dot(cross(z, x), n), dot(cross(x, y), n)) * sign(dot(x, yz)));
}

vec3 morphed_normal(vec3 n) {
    uint blocks = (position_stream.length() + kPoseBlock - 1) / kPoseBlock;
    for (uint k = 0; k < targets.length(); ++k) {
        uint first = first_normal_changes[targets[k].target * blocks + gl_WorkGroupID.x];
        if (first != kNoBlock) n += targets[k].weight * normal_changes[first + gl_LocalInvocationID.x];
    }
    return n;
}

vec3 posed_normal(MovingVertex vertex, Around around) {
    vec3 n = vertex.normal;
    if (has_normal_changes != 0) n = morphed_normal(n);
    n = skinned_normal(vertex.place, n);
    if (dot(n, n) < kLeastNormalSquared)
        return around.normal_after == vec3(0.0) ? vec3(0.0, 1.0, 0.0) : around.normal_after;
    if (around.normal_before == around.normal_after) return n;
    if (dot(around.normal_before, around.normal_after) < kOppositeNormals) return n;
    return unit(turned(around.normal_before, around.normal_after, n));
}

float tension_of(float area, float at_rest) {
    if (!(at_rest > 0.0)) return 0.0;
    return area > 0.0 ? clamp(log(area / at_rest), -kMostTension, kMostTension) : -kMostTension;
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= position_stream.length()) return;
    MovingVertex vertex = vertices[i];
    Around around = walk_around(vertex.place, vertex.first_corner, vertices[i + 1].first_corner);
    vec3 p = positions_mm[vertex.place], n = posed_normal(vertex, around), direction = around.direction;
    if (direction == vec3(0.0)) direction = positions_mm[vertex.beside] - p;
    vec3 t = unit(direction - n * dot(n, direction));
    mat3 frame = mat3(t, cross(n, t), n);
    vec3 d = vertex.curvature_diagonal_per_mm, m = vertex.curvature_mixed_per_mm;
    mat3 tensor = frame * mat3(d.x, m.z, m.y, m.z, d.y, m.x, m.y, m.x, d.z) * transpose(frame);
    position_stream[i] = p;
    normal_stream[i] = n;
    tangent_stream[i] = vec4(frame * vertex.tangent.xyz, vertex.tangent.w);
    diagonal_stream[i] = vec3(tensor[0][0], tensor[1][1], tensor[2][2]);
    mixed_stream[i] = vec3(tensor[1][2], tensor[0][2], tensor[0][1]);
    float per_area = around.uv_area > 0.0 ? 1.0 / around.uv_area : 0.0;
    du_stream[i] = around.du * per_area;
    dv_stream[i] = around.dv * per_area;
    tension_stream[i] = tension_of(around.area, vertex.rest_area);
}
