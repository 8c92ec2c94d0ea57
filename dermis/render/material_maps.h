#pragma once
// A material's maps, decoded and laid out for the GPU.

#include <optional>
#include <string>

#include "dermis/gpu/device.h"
#include "dermis/image/image.h"
#include "dermis/mesh/material.h"
#include "dermis/mesh/mesh.h"
#include "dermis/scene/scene.h"

namespace dermis::inline render {

/// One texture of shaders/include/surface.glsl: where a material names its image, and the texel that replaces
/// a missing one.
struct MaterialMap {
    std::string texture;  ///< the shader's name
    ImageSource Material::*source;
    bool is_color = false;                          ///< sRGB colour with four channels; otherwise data
    bool is_normals = false;                        ///< unit vectors
    ImageSource Material::*second_layer = nullptr;  ///< of an array texture of normals; either may be absent
    bool is_single = false;                         ///< one channel is taken
    int preferred_channel = 0;                ///< where it lies, if the image has that many channels; else 0
    ImageSource Material::*packed = nullptr;  ///< taken when `source` is absent: a map that holds several
    int packed_channel = 0;
    std::array<uint8_t, 4> neutral = {255, 255, 255, 255};
};
[[nodiscard]] const std::vector<MaterialMap>& material_maps();

/// The image that fills `map` for this material, or null.
[[nodiscard]] const ImageSource* map_source(const MaterialMap& map, const Material& material);

struct LoadedMap {
    gpu::TextureData texture;
    std::string warning;  ///< names the file; empty: nothing looks wrong
};
/// Reads and decodes one map; level 0 only, mips are made on the device. Where the material asks for it the
/// islands of the mesh's atlas grow into their gutter. Errors name the file.
[[nodiscard]] Result<LoadedMap> load_material_map(const MaterialMap& map, const Material& material,
                                                  const Mesh& mesh);

/// One line for each skin material of the scene that has no image for `texture`.
[[nodiscard]] std::vector<std::string> missing_map_warnings(const Scene& scene, std::string_view texture);

/// A texture of 1 x 1 texels in its place.
[[nodiscard]] gpu::TextureData neutral_map(const MaterialMap& map);

// Whether an image can be the normal map that it is given as.

/// A probable mistake and its fix, in one line without the file's name: an object-space map given as a
/// tangent-space one, a tangent-space map given as an object-space one, or an image that is not a normal map.
/// A normal map holds unit vectors; those of a tangent-space map point out of the surface, those of a head in
/// object space in all directions. Texels of black or white between the charts do not count.
[[nodiscard]] std::optional<std::string> doubt_of_normal_map(const Image& image, NormalSpace space);

}  // namespace dermis::inline render
