#pragma once
// Materials into a GLB under construction. Internal to dermis/mesh.

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/mesh/write_mesh.h"

namespace dermis::inline mesh::gltf {

using Json = nlohmann::ordered_json;

[[nodiscard]] inline Json array_of(Vec3 v) {
    return {v.x, v.y, v.z};
}

struct GlbContent {
    Json root;
    std::vector<std::byte> binary;  ///< the one buffer

    /// Appends bytes, padded to four; the number of their buffer view.
    size_t add_view(std::span<const std::byte> bytes, std::optional<int> target);
};

/// Materials, textures, images and the list of extensions used.
[[nodiscard]] Result<void> add_materials(GlbContent& glb, std::span<const Material> materials,
                                         std::span<const NamedImage> images);

}  // namespace dermis::inline mesh::gltf
