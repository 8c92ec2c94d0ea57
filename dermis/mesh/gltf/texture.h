#pragma once
// Which UVs a texture of a glTF material takes, and what it has beyond its edges. Internal to dermis/mesh.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "dermis/base/vec.h"
#include "dermis/mesh/gltf/document.h"

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

/// Of one textureInfo object.
[[nodiscard]] UvMapping uv_mapping(const JsonView& texture_info);

/// Whether the texture of a textureInfo object names an image; one in a format of an extension alone does
/// not.
[[nodiscard]] bool has_picture(Document& document, const JsonView& texture_info);

/// A mesh has one set of UVs, so a material has one mapping: that of its first texture with a picture in the
/// order base colour, normal, roughness, emission, occlusion, extensions. Textures with another are left out
/// by the reader of materials.
[[nodiscard]] UvMapping uv_mapping_of_material(Document& document, const JsonView& material);

}  // namespace dermis::inline mesh::gltf
