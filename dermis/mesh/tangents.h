#pragma once
// Tangent frames for normal maps, as MikkTSpace defines them.

#include "dermis/mesh/mesh.h"

namespace dermis::inline mesh {

/// Needs normals and UVs (without UVs: any frame perpendicular to the normal). Replaces mesh.tangents and
/// splits the vertices whose triangles demand different frames (mirrored UVs), so the vertex count may grow.
///
/// Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited", as its reference implementation and glTF take
/// it: per-triangle directions of u, projected into each vertex's normal plane, unit, summed with the weight
/// of the corner angle over the triangles that share position, normal and UV and hang together by edges,
/// never across a change of the UVs' handedness. The sign is glTF's: bitangent = w * cross(normal, tangent)
/// points up in the texture image, towards smaller v. Triangles without area in UV take part in their
/// neighbours' frames; where there are none, the frame is an arbitrary perpendicular one. Never NaN. The
/// result does not depend on the order of vertices, nor, up to rounding, of triangles. Linear time.
///
/// Measured against the reference implementation (npm mikktspace 1.1): the 156,660 corners of a face of
/// 52,220 triangles agree to 0.05 degrees, every sign too; of the 51,657 corners with UV area of a scanned
/// head all but 22, which touch triangles without.
void compute_tangents(Mesh& mesh);

/// Makes given tangents unit and perpendicular to their normals; those that are missing (zero) or unusable
/// are computed as by compute_tangents, the others kept. Without any: compute_tangents.
void complete_tangents(Mesh& mesh);

}  // namespace dermis::inline mesh
