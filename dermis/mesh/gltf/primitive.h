#pragma once
// One primitive of a glTF mesh as plain arrays. Internal to dermis/mesh.

#include <cstdint>
#include <span>
#include <vector>

#include "dermis/mesh/gltf/document.h"
#include "dermis/mesh/gltf/skin.h"
#include "dermis/mesh/gltf/texture.h"

namespace dermis::inline mesh::gltf {

/// Numbers a vertex: 3 of a position and a normal, 4 of a tangent and a colour, 2 of a UV; empty where the
/// file has none.
struct Primitive {
    std::vector<float> positions, normals, tangents, uvs, colors;
    Influences influences;
    std::vector<uint32_t> indices;  ///< a triangle list
};

struct PrimitiveOptions {
    UvMapping uv_mapping;          ///< of its material
    size_t joint_count = 0;        ///< 0: not skinned
    std::span<const float> morph;  ///< weights of the morph targets, none: all 0
};

/// False for what is skipped (points, lines, no positions), with a warning, and after an error.
[[nodiscard]] bool read_primitive(Document& document, const JsonView& source, const PrimitiveOptions& options,
                                  Primitive& primitive);

}  // namespace dermis::inline mesh::gltf
