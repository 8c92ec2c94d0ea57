// Polygons to triangles: quads by the better diagonal, larger faces by ear clipping in the plane of their
// Newell normal (Meisters 1975, "Polygons have ears").

#include "dermis/mesh/polygons.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "dermis/mesh/topology.h"

namespace dermis::inline mesh {
namespace {

// Twice the vector area, in double: scanned faces are small and far from the origin.
Vec3 newell_normal(std::span<const Vec3> corners) {
    double x = 0, y = 0, z = 0;
    for (size_t i = 0; i < corners.size(); ++i) {
        const Vec3 a = corners[i] - corners[0], b = corners[(i + 1) % corners.size()] - corners[0];
        x += double(a.y) * b.z - double(a.z) * b.y;
        y += double(a.z) * b.x - double(a.x) * b.z;
        z += double(a.x) * b.y - double(a.y) * b.x;
    }
    return {float(x), float(y), float(z)};
}

std::vector<Vec2> project(std::span<const Vec3> corners, Vec3 normal) {
    const Vec3 n = normalize(normal);
    const Vec3 helper = std::abs(n.x) < 0.6f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 x_axis = normalize(cross(helper, n)), y_axis = cross(n, x_axis);
    std::vector<Vec2> points;
    for (const Vec3& corner : corners) {
        const Vec3 p = corner - corners[0];
        points.push_back({dot(p, x_axis), dot(p, y_axis)});
    }
    return points;
}

bool inside_triangle(Vec2 p, Vec2 a, Vec2 b, Vec2 c) {
    return cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0;
}

void cut_quad(std::span<const Vec3> p, std::vector<uint32_t>& triangles) {
    // A diagonal is inside when its two triangles face the same way as the whole.
    const Vec3 n = newell_normal(p);
    const auto faces_n = [&](int a, int b, int c) { return dot(cross(p[b] - p[a], p[c] - p[a]), n) > 0; };
    const bool inside_02 = faces_n(0, 1, 2) && faces_n(0, 2, 3);
    const bool inside_13 = faces_n(0, 1, 3) && faces_n(1, 2, 3);
    const bool shorter_02 = length(p[2] - p[0]) <= length(p[3] - p[1]);
    const bool cut_02 = inside_02 == inside_13 ? shorter_02 : inside_02;
    if (cut_02)
        triangles.insert(triangles.end(), {0, 1, 2, 0, 2, 3});
    else
        triangles.insert(triangles.end(), {0, 1, 3, 1, 2, 3});
}

// Whether the direction leads from the second of three corners into the triangle.
bool leads_inside(Vec2 direction, Vec2 before, Vec2 corner, Vec2 after) {
    return cross(after - corner, direction) > 0 && cross(direction, before - corner) > 0;
}

class EarClipper {
  public:
    explicit EarClipper(std::span<const Vec3> corners)
        : points_(project(corners, newell_normal(corners))), ring_(corners.size()) {
        std::iota(ring_.begin(), ring_.end(), 0u);
    }

    void run(std::vector<uint32_t>& triangles) {
        while (ring_.size() > 3) {
            const size_t at = next_cut();
            triangles.insert(triangles.end(), {corner(at, -1), corner(at, 0), corner(at, 1)});
            ring_.erase(ring_.begin() + std::ptrdiff_t(at));
        }
        triangles.insert(triangles.end(), ring_.begin(), ring_.end());
    }

  private:
    [[nodiscard]] uint32_t corner(size_t at, int step) const {
        return ring_[(at + ring_.size() + size_t(step)) % ring_.size()];
    }
    [[nodiscard]] Vec2 point(size_t at, int step) const { return points_[corner(at, step)]; }
    [[nodiscard]] float turn(size_t at) const {
        return cross(point(at, 0) - point(at, -1), point(at, 1) - point(at, 0));
    }

    // An ear; else a corner without area, which is what remains of an edge run along twice; else, in a face
    // that crosses itself, any.
    [[nodiscard]] size_t next_cut() const {
        for (size_t at = 0; at < ring_.size(); ++at)
            if (is_ear(at)) return at;
        for (size_t at = 0; at < ring_.size(); ++at)
            if (turn(at) == 0) return at;
        return 0;
    }

    [[nodiscard]] bool is_ear(size_t at) const {
        if (turn(at) <= 0) return false;
        const std::array<Vec2, 3> ear = {point(at, -1), point(at, 0), point(at, 1)};
        for (size_t other = 0; other < ring_.size(); ++other)
            if (blocks(other, ear)) return false;
        return true;
    }

    // A corner that lies in the triangle, or at a corner of it with an edge into it: the outline comes twice
    // to where it goes over to a hole.
    [[nodiscard]] bool blocks(size_t other, const std::array<Vec2, 3>& ear) const {
        const Vec2 p = point(other, 0);
        for (size_t k = 0; k < 3; ++k)
            if (p == ear[k])
                return leads_inside(point(other, -1) - p, ear[(k + 2) % 3], p, ear[(k + 1) % 3]) ||
                       leads_inside(point(other, 1) - p, ear[(k + 2) % 3], p, ear[(k + 1) % 3]);
        return inside_triangle(p, ear[0], ear[1], ear[2]);
    }

    std::vector<Vec2> points_;
    std::vector<uint32_t> ring_;  // corners that are left
};

struct CornerValues {
    Vec2 uv;
    Vec3 normal;
};

CornerValues values_of(const PolygonMesh& polygons, size_t corner) {
    CornerValues values;
    if (!polygons.corner_uvs.empty() && polygons.corner_uvs[corner] != kNoIndex)
        values.uv = polygons.uvs[polygons.corner_uvs[corner]];
    if (!polygons.corner_normals.empty() && polygons.corner_normals[corner] != kNoIndex)
        values.normal = polygons.normals[polygons.corner_normals[corner]];
    return values;
}

Weld weld_corners(const PolygonMesh& polygons) {
    std::vector<uint32_t> words;
    words.reserve(polygons.corner_positions.size() * 6);
    for (size_t corner = 0; corner < polygons.corner_positions.size(); ++corner) {
        words.push_back(polygons.corner_positions[corner]);
        const CornerValues v = values_of(polygons, corner);
        for (const float value : {v.uv.x, v.uv.y, v.normal.x, v.normal.y, v.normal.z})
            words.push_back(weld_key(value));
    }
    return weld_records(words, 6);
}

// Material numbers in order of first use.
std::vector<uint32_t> used_materials(const PolygonMesh& polygons) {
    std::vector<uint32_t> order;
    std::vector<bool> seen(polygons.materials.size(), false);
    for (const uint32_t material : polygons.face_materials)
        if (!seen[material]) seen[material] = true, order.push_back(material);
    return order;
}

}  // namespace

void triangulate_polygon(std::span<const Vec3> corners, std::vector<uint32_t>& triangles) {
    if (corners.size() == 3)
        triangles.insert(triangles.end(), {0, 1, 2});
    else if (corners.size() == 4)
        cut_quad(corners, triangles);
    else if (corners.size() <= kMaxEarClipping)
        EarClipper(corners).run(triangles);
    else
        for (uint32_t i = 1; i + 1 < corners.size(); ++i) triangles.insert(triangles.end(), {0, i, i + 1});
}

Mesh triangulate(const PolygonMesh& polygons) {
    const Weld weld = weld_corners(polygons);
    Mesh mesh;
    for (const uint32_t corner : weld.first) {
        const CornerValues values = values_of(polygons, corner);
        mesh.positions_mm.push_back(polygons.positions_mm[polygons.corner_positions[corner]]);
        if (!polygons.corner_uvs.empty()) mesh.uvs.push_back(values.uv);
        if (!polygons.corner_normals.empty()) mesh.normals.push_back(values.normal);
    }
    const std::vector<uint32_t> order = used_materials(polygons);
    std::vector<std::vector<uint32_t>> by_material(polygons.materials.size());
    std::vector<Vec3> corners;
    std::vector<uint32_t> local;
    size_t first_corner = 0;
    for (size_t face = 0; face < polygons.face_count(); ++face) {
        const uint32_t size = polygons.face_sizes[face];
        corners.clear(), local.clear();
        for (uint32_t i = 0; i < size; ++i)
            corners.push_back(polygons.positions_mm[polygons.corner_positions[first_corner + i]]);
        triangulate_polygon(corners, local);
        for (const uint32_t i : local)
            by_material[polygons.face_materials[face]].push_back(weld.ids[first_corner + i]);
        first_corner += size;
    }
    mesh.materials = polygons.materials;
    for (const uint32_t material : order) {
        mesh.submeshes.push_back({.name = polygons.materials[material].name,
                                  .first_index = uint32_t(mesh.indices.size()),
                                  .index_count = uint32_t(by_material[material].size()),
                                  .material = material});
        mesh.indices.insert(mesh.indices.end(), by_material[material].begin(), by_material[material].end());
    }
    return mesh;
}

PolygonMesh polygons_of(const Mesh& mesh) {
    PolygonMesh polygons;
    polygons.materials = mesh.materials;
    const Weld positions = weld_positions(mesh.positions_mm);
    for (const uint32_t vertex : positions.first) polygons.positions_mm.push_back(mesh.positions_mm[vertex]);
    for (const uint32_t index : mesh.indices) polygons.corner_positions.push_back(positions.ids[index]);
    if (!mesh.uvs.empty()) {
        std::vector<uint32_t> words;
        for (size_t i = 0; i < mesh.uvs.size(); ++i)
            words.insert(words.end(), {positions.ids[i], weld_key(mesh.uvs[i].x), weld_key(mesh.uvs[i].y)});
        const Weld uvs = weld_records(words, 3);
        for (const uint32_t vertex : uvs.first) polygons.uvs.push_back(mesh.uvs[vertex]);
        for (const uint32_t index : mesh.indices) polygons.corner_uvs.push_back(uvs.ids[index]);
    }
    polygons.face_sizes.assign(mesh.triangle_count(), 3);
    for (const Submesh& submesh : mesh.submeshes)
        polygons.face_materials.insert(polygons.face_materials.end(), submesh.index_count / 3,
                                       submesh.material);
    return polygons;
}

}  // namespace dermis::inline mesh
