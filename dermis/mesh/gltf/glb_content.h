#pragma once
// A GLB that is being written. Internal to dermis/mesh.

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

#include "dermis/base/vec.h"
#include "dermis/mesh/mesh.h"
#include "dermis/mesh/rig.h"

namespace dermis::inline mesh::gltf {

/// Members keep their order. One that is referred to moves when another is added.
using OrderedJson = nlohmann::ordered_json;

enum : int { kU16 = 5123, kU32 = 5125, kF32 = 5126, kArrayBuffer = 34962, kElementArrayBuffer = 34963 };

/// Numbers of vertices as a view holds them.
struct PackedIndices {
    std::vector<std::byte> bytes;
    int component = kU32;
};
/// In 16 bits where all numbers of `vertices` fit; glTF keeps the largest one free.
[[nodiscard]] PackedIndices packed_indices(std::span<const uint32_t> indices, size_t vertices);

struct GlbContent {
    OrderedJson root;
    std::vector<std::byte> binary;  ///< the one buffer

    /// Appends bytes, padded to four; the number of their buffer view.
    size_t add_view(std::span<const std::byte> bytes, std::optional<int> target);
    size_t add_accessor(std::span<const std::byte> bytes, size_t count, int component, const char* type,
                        std::optional<int> target);
    /// Floats, one element a vertex.
    template <class T>
    size_t add_attribute(const std::vector<T>& values, const char* type) {
        return add_accessor(std::as_bytes(std::span(values)), values.size(), kF32, type, kArrayBuffer);
    }
    /// Vectors that are mostly zero take the others alone. `bounded`: with min and max.
    size_t add_changes(const std::vector<Vec3>& changes, bool bounded);
    /// min and max of the last accessor.
    void set_bounds(std::span<const Vec3> values);
};

/// Attributes of glTF by name, to which further ones may be added; `more_uvs` as in glb_bytes().
[[nodiscard]] OrderedJson add_attributes(GlbContent& glb, const Mesh& mesh,
                                         std::span<const std::vector<Vec2>> more_uvs);
/// Appends a mesh with a primitive for each submesh, all with the attributes and targets.
void add_mesh(GlbContent& glb, const Mesh& mesh, const OrderedJson& attributes,
              const OrderedJson& targets = nullptr);

/// Nodes, skins, meshes and animations of a rig.
void add_rig(GlbContent& glb, const Rig& rig, std::span<const std::vector<Vec2>> more_uvs);

}  // namespace dermis::inline mesh::gltf
