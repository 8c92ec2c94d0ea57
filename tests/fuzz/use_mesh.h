#pragma once
// After a successful load: the guarantees of read_mesh.h hold, and no function on the mesh crashes.

#include <cmath>
#include <cstdlib>

#include "dermis/mesh/curvature.h"
#include "dermis/mesh/read_mesh.h"
#include "dermis/mesh/subdivide.h"
#include "dermis/mesh/uv_report.h"

namespace dermis::fuzz {

inline void require(bool condition) {
    if (!condition) std::abort();
}

inline void use_mesh(const LoadedMesh& loaded) {
    const Mesh& mesh = loaded.mesh;
    require(!mesh.indices.empty() && mesh.indices.size() % 3 == 0 && !mesh.materials.empty());
    require(mesh.normals.size() == mesh.positions_mm.size() &&
            mesh.tangents.size() == mesh.positions_mm.size());
    for (const uint32_t index : mesh.indices) require(index < mesh.positions_mm.size());
    for (const Vec3& n : mesh.normals) require(std::abs(length(n) - 1) < 1e-3f);
    for (const Vec4& t : mesh.tangents) require(std::abs(length({t.x, t.y, t.z}) - 1) < 1e-3f);
    for (const Submesh& submesh : mesh.submeshes) require(submesh.material < mesh.materials.size());
    if (mesh.triangle_count() > 2000) return;  // the rest is slow under a sanitizer
    for (const float h : compute_curvature(mesh)) require(std::isfinite(h));
    if (!mesh.uvs.empty()) (void)analyze_uvs(mesh, std::nullopt, 64);
    (void)subdivide(polygons_of(mesh), 1);
}

}  // namespace dermis::fuzz
