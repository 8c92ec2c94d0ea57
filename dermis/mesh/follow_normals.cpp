#include "dermis/mesh/follow_normals.h"

#include "dermis/mesh/normals.h"
#include "shaders/include/posing.h"

namespace dermis::inline mesh {
namespace {

// Vertices of the triangles that have moved.
std::vector<uint8_t> around_moved(std::span<const Vec3> before_mm, const Mesh& mesh) {
    std::vector<uint8_t> moved(before_mm.size());
    for (size_t i = 0; i < moved.size(); ++i) moved[i] = !(before_mm[i] == mesh.positions_mm[i]);
    std::vector<uint8_t> around(before_mm.size());
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const uint32_t* v = &mesh.indices[i];
        if (moved[v[0]] | moved[v[1]] | moved[v[2]]) around[v[0]] = around[v[1]] = around[v[2]] = 1;
    }
    return around;
}

}  // namespace

void turn_normals(std::span<const Vec3> before_mm, Mesh& mesh) {
    SmoothNormals smooth(mesh.indices);
    turn_normals(before_mm, mesh, smooth);
}

void turn_normals(std::span<const Vec3> before_mm, Mesh& mesh, SmoothNormals& smooth) {
    Weld weld_before = weld_positions(before_mm), weld_after = weld_positions(mesh.positions_mm);
    // Where other positions coincide, normals change without a move.
    std::vector<uint8_t> wanted;
    if (weld_before.ids == weld_after.ids) wanted = around_moved(before_mm, mesh);
    const std::vector<Vec3> before = smooth.of_vertices(before_mm, std::move(weld_before), wanted),
                            after = smooth.of_vertices(mesh.positions_mm, std::move(weld_after), wanted);
    for (size_t i = 0; i < before.size(); ++i) {
        if (before[i] == after[i] || dot(before[i], after[i]) < posing::kOppositeNormals) continue;
        mesh.normals[i] = posing::turned(before[i], after[i], mesh.normals[i]);
        if (mesh.tangents.empty()) continue;
        Vec4& t = mesh.tangents[i];
        const Vec3 turned = posing::turned(before[i], after[i], {t.x, t.y, t.z});
        t = {turned.x, turned.y, turned.z, t.w};
    }
}

}  // namespace dermis::inline mesh
