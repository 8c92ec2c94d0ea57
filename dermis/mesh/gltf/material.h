#pragma once
// Materials of a glTF file. Internal to dermis/mesh.

#include <vector>

#include "dermis/mesh/gltf/document.h"
#include "dermis/mesh/material.h"

namespace dermis::inline mesh::gltf {

/// All materials of the file, in its order. `mm_per_unit` is the size of a file unit; `node_scales` has, for
/// every material, the scale of the node that uses it (thickness is stated in the mesh's own space).
[[nodiscard]] std::vector<Material> read_materials(Document& document, double mm_per_unit,
                                                   const std::vector<double>& node_scales);

}  // namespace dermis::inline mesh::gltf
