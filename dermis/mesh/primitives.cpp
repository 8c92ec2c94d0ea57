#include "dermis/mesh/primitives.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "dermis/mesh/topology.h"

namespace dermis::inline mesh {
namespace {

constexpr float kTau = 2 * std::numbers::pi_v<float>;

struct Point {
    Vec3 position_mm, normal, tangent;
    float along_per_mm = 0, across_per_mm = 0;  // curvatures along the tangent and at right angles to it
};

Mesh with_one_material(Mesh mesh, const char* name) {
    mesh.materials.emplace_back().name = name;
    mesh.submeshes.push_back({.name = name, .index_count = uint32_t(mesh.indices.size()), .material = 0});
    return mesh;
}

enum class Poles { none, at_first_and_last_row };

// A surface over (u, v) in [0, 1]^2, v downwards in the texture. The first and last column are not merged, so
// that u can start again; at a pole the row is a point, and the triangles that would have no area are left
// out.
Mesh make_grid(const char* name, int columns, int rows, Poles poles,
               const std::function<Point(float, float)>& at) {
    Mesh mesh;
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column) {
            const Vec2 uv = {float(column) / float(columns), float(row) / float(rows)};
            const Point point = at(uv.x, uv.y);
            mesh.positions_mm.push_back(point.position_mm);
            mesh.normals.push_back(point.normal);
            mesh.tangents.push_back({point.tangent.x, point.tangent.y, point.tangent.z, 1});
            mesh.uvs.push_back(uv);
            mesh.curvatures_per_mm.push_back(tangent_curvature(
                point.tangent, cross(point.normal, point.tangent), point.along_per_mm, point.across_per_mm));
        }
    const bool has_poles = poles == Poles::at_first_and_last_row;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const auto a = uint32_t(row * (columns + 1) + column), b = a + 1;
            const uint32_t c = a + uint32_t(columns) + 1, d = c + 1;
            if (!has_poles || row > 0) mesh.indices.insert(mesh.indices.end(), {a, d, b});
            if (!has_poles || row + 1 < rows) mesh.indices.insert(mesh.indices.end(), {a, c, d});
        }
    drop_unused_vertices(mesh);  // at each pole one of the column of copies
    return with_one_material(std::move(mesh), name);
}

// On the unit circle around Y, from the back through -X and the front; exactly closed.
struct Around {
    float x, z;
    explicit Around(float u) {
        const float angle = u >= 1 ? 0 : u * kTau;
        x = -std::sin(angle), z = -std::cos(angle);
    }
    [[nodiscard]] Vec3 tangent() const { return {z, 0, -x}; }
};

}  // namespace

Mesh make_sphere(float radius_mm, int segments) {
    const int columns = std::max(segments, 3), rows = std::max(columns / 2, 2);
    return make_grid("sphere", columns, rows, Poles::at_first_and_last_row, [&](float u, float v) {
        const Around around(u);
        const float ring = v <= 0 || v >= 1 ? 0 : std::sin(v * kTau / 2);
        const Vec3 n = {ring * around.x, std::cos(v * kTau / 2), ring * around.z};
        return Point{n * radius_mm, n, around.tangent(), 1 / radius_mm, 1 / radius_mm};
    });
}

Mesh make_torus(float major_mm, float minor_mm, int segments) {
    const int count = std::max(segments, 3);
    return make_grid("torus", count, count, Poles::none, [&](float u, float v) {
        // v runs over the top, from the inside outwards, and back below.
        const Around around(u);
        const float angle = v >= 1 ? 0 : v * kTau, out = -std::cos(angle), up = std::sin(angle);
        const Vec3 n = {out * around.x, up, out * around.z};
        const Vec3 centre = {major_mm * around.x, 0, major_mm * around.z};
        return Point{centre + n * minor_mm, n, around.tangent(), out / (major_mm + minor_mm * out),
                     1 / minor_mm};
    });
}

Mesh make_cylinder(float radius_mm, float height_mm, int segments) {
    const int columns = std::max(segments, 3);
    const float cells = height_mm / (kTau * radius_mm) * float(columns);
    const int rows = int(std::clamp(std::round(cells), 1.0f, 4096.0f));
    return make_grid("cylinder", columns, rows, Poles::none, [&](float u, float v) {
        const Around around(u);
        const Vec3 n = {around.x, 0, around.z};
        return Point{n * radius_mm + Vec3{0, (0.5f - v) * height_mm, 0}, n, around.tangent(), 1 / radius_mm};
    });
}

Mesh make_plane(float width_mm, float height_mm, int segments) {
    const int count = std::max(segments, 1);
    return make_grid("plane", count, count, Poles::none, [&](float u, float v) {
        return Point{{(u - 0.5f) * width_mm, (0.5f - v) * height_mm, 0}, {0, 0, 1}, {1, 0, 0}};
    });
}

Mesh make_box(Vec3 size_mm) {
    struct Face {
        Vec3 normal, right;  // as seen from outside, with the picture upright
    };
    static constexpr Face kFaces[6] = {{{0, 0, 1}, {1, 0, 0}},   {{1, 0, 0}, {0, 0, -1}},
                                       {{0, 0, -1}, {-1, 0, 0}}, {{-1, 0, 0}, {0, 0, 1}},
                                       {{0, 1, 0}, {1, 0, 0}},   {{0, -1, 0}, {1, 0, 0}}};
    Mesh mesh;
    for (uint32_t f = 0; f < 6; ++f) {
        const auto [n, right] = kFaces[f];
        const Vec3 up = cross(n, right);
        const Vec2 cell = {float(f % 3) / 3, float(f / 3) / 2};
        for (const Vec2 corner : {Vec2{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            const Vec3 p = n + right * (2 * corner.x - 1) + up * (1 - 2 * corner.y);
            mesh.positions_mm.push_back(p * size_mm * 0.5f);
            mesh.normals.push_back(n);
            mesh.tangents.push_back({right.x, right.y, right.z, 1});
            mesh.uvs.push_back({cell.x + corner.x / 3, cell.y + corner.y / 2});
            mesh.curvatures_per_mm.emplace_back();
        }
        const uint32_t a = 4 * f;
        mesh.indices.insert(mesh.indices.end(), {a, a + 3, a + 2, a, a + 2, a + 1});
    }
    return with_one_material(std::move(mesh), "box");
}

}  // namespace dermis::inline mesh
