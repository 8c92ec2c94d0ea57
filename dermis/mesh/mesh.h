#pragma once
// A triangle mesh as the renderer, the bakers and the ground truth take it: millimetres, indexed, welded by
// attribute.

#include <cstdint>
#include <string>
#include <vector>

#include "dermis/base/vec.h"
#include "dermis/mesh/material.h"

namespace dermis {

/// A run of triangles with one material.
struct Submesh {
    std::string name;
    uint32_t first_index = 0, index_count = 0;
    uint32_t material = 0;  ///< into Mesh::materials
};

/// Structure of arrays; every attribute is empty or has one entry a position. Right-handed, Y up,
/// counter-clockwise fronts, UV origin top-left (v down, as glTF and Vulkan have it; OBJ's bottom-left is
/// flipped on load).
struct Mesh {
    std::vector<Vec3> positions_mm;
    std::vector<Vec3> normals;   ///< unit
    std::vector<Vec4> tangents;  ///< unit xyz along +u; w = +1 or -1, bitangent = w * cross(normal, tangent)
                                 ///< points up in the texture image (towards smaller v), as glTF has it
    std::vector<Vec2> uvs;
    std::vector<Vec4> colors_linear;       ///< multiply base colour and opacity
    std::vector<float> curvatures_per_mm;  ///< signed mean curvature, positive where convex
    std::vector<float> occlusions;         ///< ambient visibility, 0 closed in, 1 open
    std::vector<uint32_t> indices;         ///< three a triangle
    std::vector<Submesh> submeshes;        ///< cover all indices, in order
    std::vector<Material> materials;       ///< at least one

    [[nodiscard]] size_t triangle_count() const { return indices.size() / 3; }
};

}  // namespace dermis
