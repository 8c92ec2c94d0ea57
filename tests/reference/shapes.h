#pragma once
// Meshes whose curvature, thickness and visibility are known.

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "dermis/mesh/mesh.h"

namespace dermis::test {

/// A grid of (across + 1) x (down + 1) vertices, uv 0..1, `place(u, v)` gives position and normal.
template <class Place>
Mesh grid(int across, int down, Place place) {
    Mesh mesh;
    for (int j = 0; j <= down; ++j)
        for (int i = 0; i <= across; ++i) {
            const float u = float(i) / float(across), v = float(j) / float(down);
            const auto [position, normal] = place(u, v);
            mesh.positions_mm.push_back(position);
            mesh.normals.push_back(normal);
            mesh.uvs.push_back({u, v});
        }
    for (int j = 0; j < down; ++j)
        for (int i = 0; i < across; ++i) {
            const auto a = uint32_t(j * (across + 1) + i), b = a + uint32_t(across) + 1;
            for (const uint32_t index : {a, b, a + 1, a + 1, b, b + 1}) mesh.indices.push_back(index);
        }
    mesh.submeshes = {{.name = "all", .index_count = uint32_t(mesh.indices.size())}};
    mesh.materials = {{.base_color_linear = {1, 1, 1}}};
    return mesh;
}

struct Placed {
    Vec3 position, normal;
};

/// Whole turns end where they began, to the last bit: a seam is welded by equal positions.
inline float turn_rad(float u) {
    return u == 1 ? 0 : 2 * std::numbers::pi_v<float> * u;
}

inline Mesh moved(Mesh mesh, Vec3 by_mm) {
    for (Vec3& p : mesh.positions_mm) p += by_mm;
    return mesh;
}

/// An icosahedron cut `levels` times, vertices on the sphere; no uvs. 20 * 4^levels triangles of nearly one
/// size.
inline Mesh sphere(float radius_mm, int levels) {
    const float g = std::numbers::phi_v<float>;
    Mesh mesh;
    for (const Vec3 p : {Vec3{-1, g, 0},
                         {1, g, 0},
                         {-1, -g, 0},
                         {1, -g, 0},
                         {0, -1, g},
                         {0, 1, g},
                         {0, -1, -g},
                         {0, 1, -g},
                         {g, 0, -1},
                         {g, 0, 1},
                         {-g, 0, -1},
                         {-g, 0, 1}})
        mesh.normals.push_back(normalize(p));
    mesh.indices = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                    4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                    6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
        const auto middle = [&](uint32_t a, uint32_t b) {
            const auto [at, fresh] = middles.try_emplace(std::minmax(a, b), uint32_t(mesh.normals.size()));
            if (fresh) mesh.normals.push_back(normalize(mesh.normals[a] + mesh.normals[b]));
            return at->second;
        };
        std::vector<uint32_t> cut;
        for (size_t t = 0; t < mesh.indices.size(); t += 3) {
            const uint32_t a = mesh.indices[t], b = mesh.indices[t + 1], c = mesh.indices[t + 2];
            const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            cut.insert(cut.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
        }
        mesh.indices = cut;
    }
    for (const Vec3 n : mesh.normals) mesh.positions_mm.push_back(n * radius_mm);
    mesh.submeshes = {{.name = "sphere", .index_count = uint32_t(mesh.indices.size())}};
    mesh.materials = {{.base_color_linear = {1, 1, 1}}};
    return mesh;
}

/// Longitude along u, latitude along v; with the seam and the poles such a sphere has in UV.
inline Mesh uv_sphere(float radius_mm, int across, int down) {
    return grid(across, down, [&](float u, float v) {
        const float azimuth = turn_rad(u), polar = std::numbers::pi_v<float> * v;
        const Vec3 n{std::sin(polar) * std::sin(azimuth), std::cos(polar),
                     std::sin(polar) * std::cos(azimuth)};
        return Placed{n * radius_mm, n};
    });
}

/// A square in the plane z = height, facing +z.
inline Mesh plane(float side_mm, float height_mm, int cells = 1) {
    return grid(cells, cells, [&](float u, float v) {
        return Placed{{(u - 0.5f) * side_mm, (0.5f - v) * side_mm, height_mm}, {0, 0, 1}};
    });
}

/// Every triangle turned around.
inline Mesh inside_out(Mesh mesh) {
    for (size_t i = 0; i < mesh.indices.size(); i += 3) std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    for (Vec3& n : mesh.normals) n = -n;
    return mesh;
}

/// The same square facing -z.
inline Mesh ceiling(float side_mm, float height_mm) {
    return inside_out(plane(side_mm, height_mm));
}

/// Both in one mesh; `b` keeps its material numbers after those of `a`.
inline Mesh joined(Mesh a, const Mesh& b) {
    const auto vertices = uint32_t(a.positions_mm.size()), indices = uint32_t(a.indices.size());
    const auto materials = uint32_t(a.materials.size());
    a.positions_mm.insert(a.positions_mm.end(), b.positions_mm.begin(), b.positions_mm.end());
    a.normals.insert(a.normals.end(), b.normals.begin(), b.normals.end());
    a.uvs.insert(a.uvs.end(), b.uvs.begin(), b.uvs.end());
    for (const uint32_t index : b.indices) a.indices.push_back(index + vertices);
    for (Submesh submesh : b.submeshes) {
        submesh.first_index += indices;
        submesh.material += materials;
        a.submeshes.push_back(submesh);
    }
    a.materials.insert(a.materials.end(), b.materials.begin(), b.materials.end());
    return a;
}

/// A block, x and z from -side / 2 to side / 2, its top at y = 0, with a groove along z whose flat walls meet
/// at (0, -depth, z) and part by twice the angle.
inline Mesh grooved_block(float side_mm, float depth_mm, float half_angle_rad) {
    const float a = side_mm / 2, w = depth_mm * std::tan(half_angle_rad), low = -2 * depth_mm;
    Mesh mesh;
    const auto face = [&](std::initializer_list<Vec3> corners) {
        const Vec3* c = corners.begin();
        const Vec3 n = normalize(cross(c[1] - c[0], c[2] - c[0]));
        const auto first = uint32_t(mesh.positions_mm.size());
        for (const Vec3& p : corners) {
            mesh.positions_mm.push_back(p);
            mesh.normals.push_back(n);
        }
        for (uint32_t i = 2; i < corners.size(); ++i)
            for (const uint32_t corner : {first, first + i - 1, first + i}) mesh.indices.push_back(corner);
    };
    const auto strip = [&](Vec3 p,
                           Vec3 q) {  // as seen with z towards the eye, the block to the left of p to q
        face({{p.x, p.y, -a}, {p.x, p.y, a}, {q.x, q.y, a}, {q.x, q.y, -a}});
    };
    const Vec3 outline[] = {{a, 0, 0},  {w, 0, 0},    {0, -depth_mm, 0}, {-w, 0, 0},
                            {-a, 0, 0}, {-a, low, 0}, {0, low, 0},       {a, low, 0}};
    for (size_t i = 0; i < std::size(outline); ++i) strip(outline[(i + 1) % 8], outline[i]);
    for (const float z : {-a, a})
        for (const float side : {-1.0f, 1.0f}) {
            const Vec3 corners[] = {
                {0, low, z}, {side * a, low, z}, {side * a, 0, z}, {side * w, 0, z}, {0, -depth_mm, z}};
            const Vec3* c = corners;
            if (side * z > 0)
                face({c[0], c[1], c[2], c[3], c[4]});
            else
                face({c[4], c[3], c[2], c[1], c[0]});
        }
    mesh.submeshes = {{.name = "all", .index_count = uint32_t(mesh.indices.size())}};
    mesh.materials = {{.base_color_linear = {1, 1, 1}}};
    return mesh;
}

}  // namespace dermis::test
