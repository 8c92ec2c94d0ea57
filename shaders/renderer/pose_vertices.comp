#version 460
#extension GL_GOOGLE_include_directive : require
// The streams of a mesh from its places, by one walk over the triangles around each vertex: the file's normals
// turned as the surface turns, tangents and curvature turned with the frame of normal and dP/du, curvature
// changed as its stencil's, dP/du and dP/dv of the atlas, tension.
#include "shaders/renderer/pose.glsl"

layout(constant_id = 0) const int has_normal_changes = 0;

// As CurvatureTensor.
struct Tensor {
    vec3 diagonal, mixed;
};
struct MovingVertex {
    uint place;
    // Indices where its rings and its stencil begin; they end where those of the next vertex begin.
    uint first_entry, first_stencil;
    uint influences;   // as those of a place
    uint directions;   // kAlongAtlas, or where those of its entries begin
    uint beside;       // a place that gives the frame a direction where the UVs have no area
    float rest_area;   // twice the area of the triangles around the vertex at rest, in mm^2
    vec3 normal;       // the file's, in the space of its primitive; 0 where it has none
    vec4 tangent;      // in the frame at rest, w as the mesh has it
    Tensor curvature_per_mm, stencil_per_mm;  // in the frame at rest
};
// A place around a vertex, in the order of the triangles. With the entry before it, it makes a triangle, whose dP/du of the atlas is
// edge_1 * du.x + edge_2 * du.y: edges to the place before and to its own.
struct RingEntry {
    uint place;  // and kinds
    vec2 du, dv;
};

layout(scalar) readonly buffer NormalChanges { vec3 normal_changes[]; };
layout(scalar) readonly buffer Vertices { MovingVertex vertices[]; };
layout(scalar) readonly buffer Rings { RingEntry entries[]; };
layout(scalar) readonly buffer Directions { vec2 directions[]; };  // du of the file's UVs
// CurvatureStencils::Entry. With weights of 16 bits tensors differ by .02 / mm at most from those of the CPU.
struct StencilEntry {
    uint place;
    float x, y, xx, xy, yy;
};
layout(scalar) readonly buffer Stencils { StencilEntry stencils[]; };
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
    vec3 direction, du, dv;            // weighted by area (dermis/mesh/uv_report.h)
    float uv_area, area;               // twice
    vec3 normal_before, normal_after;  // face normals weighted by angle (dermis/mesh/normals.h), at the end unit
};

// The face normal between two edges times their angle.
vec3 weighted_normal(vec3 a, vec3 b) {
    vec3 n = cross(a, b);
    float size = length(n);
    return size > 0.0 ? n / size * atan(size, dot(a, b)) : vec3(0.0);
}

Around walk_around(MovingVertex vertex, vec3 p, uint end, bool with_normals) {
    Around sum = Around(vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0, vec3(0.0), vec3(0.0));
    vec3 q = unmorphed_mm[vertex.place], last_before = vec3(0.0), last_after = vec3(0.0);
    vec3 edge_1 = vec3(0.0), before_1 = vec3(0.0);
    for (uint k = vertex.first_entry; k < end; ++k) {
        uint entry = entries[k].place, place = entry & kRingPlace;
        vec3 edge_2 = positions_mm[place] - p;
        if (with_normals) {
            vec3 before_2 = unmorphed_mm[place] - q;
            if ((entry & kCornerJoined) != 0) {
                vec3 before = weighted_normal(before_1, before_2), after = weighted_normal(edge_1, edge_2);
                sum.normal_before += before;
                sum.normal_after += after;
                if ((entry & kCornerLast) != 0) last_before = before, last_after = after;
            }
            before_1 = before_2;
        }
        if ((entry & kCornerDrawn) != 0) {
            float area = length(cross(edge_1, edge_2));
            vec2 du = entries[k].du, dv = entries[k].dv;
            sum.area += area;
            sum.du += area * (edge_1 * du.x + edge_2 * du.y);
            sum.dv += area * (edge_1 * dv.x + edge_2 * dv.y);
            sum.uv_area += (entry & kCornerInAtlas) != 0 ? area : 0.0;
            if (vertex.directions != kAlongAtlas) {
                vec2 step = directions[vertex.directions + k - vertex.first_entry];
                sum.direction += area * (edge_1 * step.x + edge_2 * step.y);
            }
        }
        edge_1 = edge_2;
    }
    if (vertex.directions == kAlongAtlas) sum.direction = sum.du;
    if (length(sum.normal_before) < kShortestNormalSum) sum.normal_before = last_before;
    if (length(sum.normal_after) < kShortestNormalSum) sum.normal_after = last_after;
    sum.normal_before = unit(sum.normal_before);
    sum.normal_after = unit(sum.normal_after);
    return sum;
}

// By the cofactors of the blended matrix: the inverse transpose up to a positive factor.
vec3 skinned_normal(uint list, vec3 n) {
    Blended to_mm = blended(list);
    vec3 x = to_mm.x.xyz, y = to_mm.y.xyz, z = to_mm.z.xyz, yz = cross(y, z);
    return unit(vec3(dot(yz, n), dot(cross(z, x), n), dot(cross(x, y), n)) * sign(dot(x, yz)));
}

vec3 morphed_normal(vec3 n) {
    uint end = targets[gl_WorkGroupID.x + 1].first;
    for (uint k = targets[gl_WorkGroupID.x].first; k < end; ++k)
        n += targets[k].weight * normal_changes[targets[k].first + gl_LocalInvocationID.x];
    return n;
}

bool is_missing(vec3 n) {
    return dot(n, n) < kLeastNormalSquared;
}

// `n`: of the file, skinned.
vec3 turned_normal(vec3 n, Around around) {
    if (is_missing(n)) return around.normal_after == vec3(0.0) ? vec3(0.0, 1.0, 0.0) : around.normal_after;
    if (around.normal_before == around.normal_after) return n;
    if (dot(around.normal_before, around.normal_after) < kOppositeNormals) return n;
    return unit(turned(around.normal_before, around.normal_after, n));
}

float tension_of(float area, float at_rest) {
    if (!(at_rest > 0.0)) return 0.0;
    return area > 0.0 ? clamp(log(area / at_rest), -kMostTension, kMostTension) : -kMostTension;
}

Tensor in_frame(mat3 frame, Tensor s) {
    vec3 d = s.diagonal, m = s.mixed;
    mat3 all = frame * mat3(d.x, m.z, m.y, m.z, d.y, m.x, m.y, m.x, d.z) * transpose(frame);
    return Tensor(vec3(all[0][0], all[1][1], all[2][2]), vec3(all[1][2], all[0][2], all[0][1]));
}

Tensor stencil_tensor(vec3 p, uint first, uint end) {
    SurfaceDerivatives sum = SurfaceDerivatives(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    for (uint k = first; k < end; ++k) {
        vec3 edge = positions_mm[stencils[k].place] - p;
        sum.x += stencils[k].x * edge;
        sum.y += stencils[k].y * edge;
        sum.xx += stencils[k].xx * edge;
        sum.xy += stencils[k].xy * edge;
        sum.yy += stencils[k].yy * edge;
    }
    CurvatureForm form = curvature_form(sum);
    vec3 x = curvature_along(form, vec3(1.0, 0.0, 0.0)), y = curvature_along(form, vec3(0.0, 1.0, 0.0)),
         z = curvature_along(form, vec3(0.0, 0.0, 1.0));
    return Tensor(vec3(x.x, y.y, z.z), vec3(y.z, x.z, x.y));
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= position_stream.length()) return;
    MovingVertex vertex = vertices[i];
    uint end = vertices[i + 1].first_entry;
    vec3 p = positions_mm[vertex.place];
    vec3 n = vertex.normal;
    if (has_normal_changes != 0) n = morphed_normal(n);
    n = skinned_normal(vertex.influences, n);
    Around around = walk_around(vertex, p, end, is_missing(n) || targets[gl_WorkGroupID.x].weight != 0.0);
    n = turned_normal(n, around);
    vec3 direction = around.direction;
    if (direction == vec3(0.0)) direction = positions_mm[vertex.beside] - p;
    vec3 t = unit(direction - n * dot(n, direction));
    mat3 frame = mat3(t, cross(n, t), n);
    Tensor curvature = in_frame(frame, vertex.curvature_per_mm), at_rest = in_frame(frame, vertex.stencil_per_mm),
           now = stencil_tensor(p, vertex.first_stencil, vertices[i + 1].first_stencil);
    vec3 diagonal = now.diagonal - at_rest.diagonal, mixed = now.mixed - at_rest.mixed;
    float limit = change_limit(diagonal, mixed);
    position_stream[i] = p;
    normal_stream[i] = n;
    tangent_stream[i] = vec4(frame * vertex.tangent.xyz, vertex.tangent.w);
    diagonal_stream[i] = curvature.diagonal + limit * diagonal;
    mixed_stream[i] = curvature.mixed + limit * mixed;
    float per_area = around.uv_area > 0.0 ? 1.0 / around.uv_area : 0.0;
    du_stream[i] = around.du * per_area;
    dv_stream[i] = around.dv * per_area;
    tension_stream[i] = tension_of(around.area, vertex.rest_area);
}
