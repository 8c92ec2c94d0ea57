#pragma once
// One primitive of a glTF mesh as plain arrays. Internal to dermis/mesh.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dermis/mesh/gltf/document.h"
#include "dermis/mesh/gltf/material.h"
#include "dermis/mesh/gltf/node_tree.h"

namespace dermis::inline mesh::gltf {

/// Every joint's matrix: from the mesh's own space, in which the skin was bound, to where the joint is now.
/// `world` has every node's transform. Empty after an error.
[[nodiscard]] std::vector<Affine> joint_matrices(Document& document, uint64_t skin,
                                                 std::span<const Affine> world);

/// Of every joint; unit matrices where the skin has none. Empty after an error.
[[nodiscard]] std::vector<Affine> inverse_bind_matrices(Document& document, const JsonView& skin,
                                                        size_t joints);

/// Joints and weights of a primitive's vertices, `per_vertex` each; weights sum to 1 (or are all 0).
struct Influences {
    size_t per_vertex = 0;  ///< 0: the primitive is not skinned
    std::vector<uint32_t> joints;
    std::vector<float> weights;
};

/// All sets JOINTS_n and WEIGHTS_n; joints are checked against `joint_count`.
[[nodiscard]] Influences read_influences(Document& document, const JsonView& attributes, size_t vertex_count,
                                         size_t joint_count);

/// The weighted sum of the matrices; `unskinned` for a vertex without weights.
[[nodiscard]] Affine blend(std::span<const Affine> joints, const Influences& influences, size_t vertex,
                           const Affine& unskinned);

/// What a morph target changes at weight 1.
struct MorphTarget {
    std::vector<uint32_t> moved;  ///< vertices of the primitive
    std::vector<Vec3> changes;    ///< of their positions
    bool has_normals = false;
    std::vector<float> normals, tangents;  ///< changes, 3 a vertex of the primitive; empty: none
};

/// At rest. Numbers a vertex: 3 of a position and a normal, 4 of a tangent and a colour, 2 of a UV; empty
/// where the file has none.
struct Primitive {
    std::vector<float> positions, normals, tangents, uvs, colors;
    Influences influences;
    std::vector<uint32_t> indices;                    ///< a triangle list
    std::vector<std::optional<MorphTarget>> targets;  ///< those that morph() has read
};

struct PrimitiveOptions {
    UvMapping uv_mapping;    ///< of its material
    size_t joint_count = 0;  ///< 0: not skinned
};

/// False for what is skipped (points, lines, no positions), with a warning, and after an error.
[[nodiscard]] bool read_primitive(Document& document, const JsonView& source, const PrimitiveOptions& options,
                                  Primitive& primitive);

/// What morph targets move of a primitive.
struct MorphedVertices {
    std::vector<float> positions, normals, tangents;
    std::vector<float> unmorphed;  ///< positions before targets that have no normals moved them; else empty
};

/// Reads the target unless it has been read. `source` is that of the primitive.
[[nodiscard]] const MorphTarget& morph_target(Document& document, const JsonView& source,
                                              Primitive& primitive, size_t index);

/// `weights` of the targets; none: all 0. Errors are left in messages: a target that cannot be read,
/// positions that are not finite.
[[nodiscard]] MorphedVertices morph(Document& document, const JsonView& source, Primitive& primitive,
                                    std::span<const float> weights);

}  // namespace dermis::inline mesh::gltf
