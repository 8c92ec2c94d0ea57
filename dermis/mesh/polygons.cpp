// Polygons to triangles: quads by the better diagonal, larger faces by ear clipping in the plane of their
// Newell normal (Meisters 1975, "Polygons have ears").

#include "dermis/mesh/polygons.h"

#include <algorithm>
#include <numeric>

#include "dermis/mesh/weld.h"

namespace dermis {
namespace {

constexpr size_t kMaxEarClipping = 512;

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

void clip_ears(std::span<const Vec3> corners, std::vector<uint32_t>& triangles) {
    const std::vector<Vec2> points = project(corners, newell_normal(corners));
    std::vector<uint32_t> ring(corners.size());
    std::iota(ring.begin(), ring.end(), 0u);
    const auto is_ear = [&](size_t at) {
        const uint32_t a = ring[(at + ring.size() - 1) % ring.size()], b = ring[at],
                       c = ring[(at + 1) % ring.size()];
        if (cross(points[b] - points[a], points[c] - points[b]) <= 0) return false;
        return std::ranges::none_of(ring, [&](uint32_t other) {
            return other != a && other != b && other != c &&
                   inside_triangle(points[other], points[a], points[b], points[c]);
        });
    };
    while (ring.size() > 3) {
        size_t at = 0;
        while (at < ring.size() && !is_ear(at)) ++at;
        at %= ring.size();  // a self-crossing face has no ear: cut anywhere
        triangles.insert(triangles.end(), {ring[(at + ring.size() - 1) % ring.size()], ring[at],
                                           ring[(at + 1) % ring.size()]});
        ring.erase(ring.begin() + std::ptrdiff_t(at));
    }
    triangles.insert(triangles.end(), ring.begin(), ring.end());
}

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
        clip_ears(corners, triangles);
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

}  // namespace dermis
