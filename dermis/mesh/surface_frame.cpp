#include "dermis/mesh/surface_frame.h"

#include "dermis/mesh/uv_report.h"

namespace dermis::inline mesh {

std::vector<Vec3> surface_directions(const Mesh& mesh) {
    std::vector<Vec3> directions(mesh.positions_mm.size());
    if (mesh.uvs.size() == mesh.positions_mm.size()) directions = vertex_uv_derivatives(mesh).du_mm;
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        const uint32_t v = mesh.indices[i], next = mesh.indices[i % 3 == 2 ? i - 2 : i + 1];
        if (directions[v] == Vec3{}) directions[v] = mesh.positions_mm[next] - mesh.positions_mm[v];
    }
    return directions;
}

CurvatureTensor moved(const SurfaceFrame& from, const SurfaceFrame& to, const CurvatureTensor& s) {
    if (from == to) return s;
    const auto column = [&](Vec3 axis) { return moved(from, to, s * moved(to, from, axis)); };
    const Vec3 x = column({1, 0, 0}), y = column({0, 1, 0}), z = column({0, 0, 1});
    return {{x.x, y.y, z.z}, {z.y, z.x, y.x}};
}

}  // namespace dermis::inline mesh
