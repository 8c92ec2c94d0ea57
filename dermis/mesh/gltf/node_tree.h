#pragma once
// The nodes of a glTF file in millimetres. Internal to dermis/mesh.

#include <cstdint>
#include <vector>

#include "dermis/mesh/gltf/document.h"
#include "dermis/mesh/gltf/transform.h"

namespace dermis::inline mesh::gltf {

struct NodeTree {
    std::vector<Affine> world;  ///< of every node, also of those outside of the default scene (joints may be)
    std::vector<uint64_t> drawn;  ///< nodes of the default scene with a mesh, in its order
};

/// `to_mm` comes after every root. Errors (a node reached twice, too many of them) are left in messages.
[[nodiscard]] NodeTree read_nodes(Document& document, const Affine& to_mm);

}  // namespace dermis::inline mesh::gltf
