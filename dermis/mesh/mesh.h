#pragma once
// The triangle mesh of renderer, bakers and reference: millimetres, indexed, welded by attribute.

#include <cstdint>
#include <string>
#include <vector>

#include "dermis/base/vec.h"
#include "dermis/mesh/material.h"

namespace dermis::inline mesh {

/// A run of triangles with one material.
struct Submesh {
    std::string name;
    uint32_t first_index = 0, index_count = 0;
    uint32_t material = 0;  ///< into Mesh::materials
};

/// Curvature tensor at a point, a symmetric 3x3 matrix in 1/mm: S d is the change of the unit normal per mm
/// along the unit tangent d, d.S d the curvature in that direction, positive where convex, and S n = 0. On a
/// sphere of radius R it is (1 - n n^T) / R, on a cylinder 1/R across its axis and 0 along it.
struct CurvatureTensor {
    Vec3 diagonal;  ///< xx, yy, zz
    Vec3 mixed;     ///< yz, xz, xy
    friend bool operator==(const CurvatureTensor&, const CurvatureTensor&) = default;
};
constexpr Vec3 operator*(const CurvatureTensor& s, Vec3 d) {
    return {s.diagonal.x * d.x + s.mixed.z * d.y + s.mixed.y * d.z,
            s.mixed.z * d.x + s.diagonal.y * d.y + s.mixed.x * d.z,
            s.mixed.y * d.x + s.mixed.x * d.y + s.diagonal.z * d.z};
}
/// Half its trace.
constexpr float mean_curvature(const CurvatureTensor& s) {
    return 0.5f * (s.diagonal.x + s.diagonal.y + s.diagonal.z);
}
/// The tensor with these entries in the frame of two tangents: tt = t.S t, bb = b.S b, tb = t.S b.
constexpr CurvatureTensor tangent_curvature(Vec3 t, Vec3 b, float tt_per_mm, float bb_per_mm,
                                            float tb_per_mm = 0) {
    const Vec3 of_t = t * tt_per_mm + b * tb_per_mm, of_b = t * tb_per_mm + b * bb_per_mm;  // S t, S b
    return {of_t * t + of_b * b,
            {of_t.y * t.z + of_b.y * b.z, of_t.x * t.z + of_b.x * b.z, of_t.x * t.y + of_b.x * b.y}};
}
/// The tensor of a surface with the same curvature in all directions.
constexpr CurvatureTensor isotropic_curvature(float curvature_per_mm, Vec3 n) {
    return {curvature_per_mm * (Vec3{1, 1, 1} - n * n),
            -curvature_per_mm * Vec3{n.y * n.z, n.x * n.z, n.x * n.y}};
}

/// Structure of arrays; every attribute is empty or has one entry per position. Right-handed, Y up,
/// counter-clockwise fronts, UV origin top-left (v down, as in glTF and Vulkan; OBJ is flipped on
/// load).
struct Mesh {
    std::vector<Vec3> positions_mm;
    std::vector<Vec3> normals;   ///< unit
    std::vector<Vec4> tangents;  ///< unit xyz along +u; w = +1 or -1, bitangent = w * cross(normal, tangent)
                                 ///< points up in the texture image (towards smaller v), as glTF has it
    std::vector<Vec2> uvs;
    std::vector<Vec2> atlas_uvs;  ///< where the scene's skin has texels of its own, for light maps and maps
                                  ///< that Dermis bakes (scene/skin_atlas.h); empty: uvs
    std::vector<Vec4> colors_linear;  ///< multiply base colour and opacity
    std::vector<CurvatureTensor> curvatures_per_mm;
    std::vector<float> occlusions;        ///< ambient visibility, 0 closed in, 1 open
    std::vector<float> tensions;          ///< of a mesh in a pose (tension.h); empty at rest
    std::vector<Vec3> rest_positions_mm;  ///< of a mesh in a pose: where its vertices are at rest
    /// Vertex of the mesh file, counted before any was dropped or split. Only of files that have clips or
    /// morph targets; empty where subdivision or displacement has made other vertices.
    std::vector<uint32_t> file_vertices;
    std::vector<uint32_t> indices;    ///< three a triangle
    std::vector<Submesh> submeshes;   ///< cover all indices, in order
    std::vector<Material> materials;  ///< at least one

    [[nodiscard]] size_t triangle_count() const { return indices.size() / 3; }
};

/// The UVs of the file, or Mesh::atlas_uvs. A mesh without atlas_uvs has its file's for both.
enum class UvSet { file, atlas };

[[nodiscard]] inline const std::vector<Vec2>& atlas_uvs_of(const Mesh& mesh) {
    return mesh.atlas_uvs.empty() ? mesh.uvs : mesh.atlas_uvs;
}

}  // namespace dermis::inline mesh
