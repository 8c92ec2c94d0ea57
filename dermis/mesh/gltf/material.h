#pragma once
// Materials of a glTF file. Internal to dermis/mesh.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "dermis/base/vec.h"
#include "dermis/mesh/gltf/document.h"
#include "dermis/mesh/material.h"

namespace dermis::inline mesh::gltf {

/// A UV set and KHR_texture_transform's change of it: scaled, turned, moved.
struct UvMapping {
    uint64_t set = 0;
    std::array<double, 2> offset = {0, 0}, scale = {1, 1};
    double rotation_rad = 0;  ///< counter-clockwise in the picture, in which v points down

    friend bool operator==(const UvMapping&, const UvMapping&) = default;
    [[nodiscard]] Vec2 apply(Vec2 uv) const;
    /// Whether the axes of a tangent frame stay what they are.
    [[nodiscard]] bool keeps_directions() const { return rotation_rad == 0 && scale[0] > 0 && scale[1] > 0; }
};

/// The content of one textureInfo object.
[[nodiscard]] UvMapping uv_mapping(const JsonView& texture_info);

/// Whether the texture of a textureInfo object names an image; one in a format of an extension alone does
/// not.
[[nodiscard]] bool has_picture(Document& document, const JsonView& texture_info);

/// A mesh has one set of UVs, so a material has one mapping: that of its first texture with a picture in the
/// order base colour, normal, roughness, emission, occlusion, extensions. Textures with another are left out
/// by the reader of materials.
[[nodiscard]] UvMapping uv_mapping_of_material(Document& document, const JsonView& material);

/// All materials of the file, in its order. `mm_per_unit` is the size of a file unit; `node_scales` has, for
/// every material, the scale of the node that uses it (thickness is stated in the mesh's own space).
[[nodiscard]] std::vector<Material> read_materials(Document& document, double mm_per_unit,
                                                   const std::vector<double>& node_scales);

}  // namespace dermis::inline mesh::gltf
